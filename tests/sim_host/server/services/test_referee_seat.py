"""One referee officiates at a time: a second one is refused by name, until the first leaves or hands over."""

from typing import Any

import pytest

from coach_gateway.access.referee_name import box_name, gateway_name, terminal_name
from runtime.bus.contract import PresenceKind
from schemas.messages.applied import Applied
from schemas.messages.soccer.game import ActionReply, RefereeAction
from schemas.messages.soccer.referee_seat import SeatOperation, SeatReply, SeatRequest
from schemas.side import Side
from schemas.soccer.game import REFBOX, ActionName
from schemas.topics import ACTION, APPLIED, EVENT, REFEREE_SEAT
from sim_host.server.services.referee_seat import BOX_DECIDES, FREE, RefereeSeat

PAGE = {"referee": "gateway_a", "source": "referee's page"}
OTHER = {"referee": "gateway_b", "source": "referee's page"}
TERMINAL = {"referee": "terminal_c", "source": "coach"}
FIRST_BOX = {"referee": box_name("10.0.0.5", 28097), "source": REFBOX}
SECOND_BOX = {"referee": box_name("10.0.0.6", 28097), "source": REFBOX}


@pytest.fixture(autouse=True)
def begun(request: pytest.FixtureRequest) -> None:
    """The match of `rig` has begun."""
    if "rig" in request.fixturenames:
        request.getfixturevalue("rig").ticks(2)


def act(rig: Any, action: ActionName, sender: dict[str, str], **about: Any) -> ActionReply:
    answer = rig.outside.query(ACTION, RefereeAction(action=action, **sender, **about))
    rig.ticks(1)
    reply: ActionReply = answer.result(0.0)
    return reply


def seat(rig: Any, operation: SeatOperation, sender: dict[str, str]) -> SeatReply:
    answer = rig.outside.query(REFEREE_SEAT, SeatRequest(operation=operation, **sender))
    rig.ticks(1)
    reply: SeatReply = answer.result(0.0)
    return reply


def test_the_first_referee_keeps_the_seat_and_the_second_is_refused_by_name_on_both_ends(rig: Any) -> None:
    events = rig.listen(EVENT)
    assert act(rig, ActionName.DROP_BALL, PAGE).accepted
    refused = act(rig, ActionName.DROP_BALL, TERMINAL)
    assert not refused.accepted
    assert refused.reason.startswith("referee's page (gateway_a) officiates; ")
    assert "touchline referee take-over" in refused.reason
    assert act(rig, ActionName.DROP_BALL, PAGE).accepted
    texts = [event.text for event in events.all() if event.rule == "referee_seat"]
    assert texts[0] == "referee's page (gateway_a) officiates"
    assert texts[1].startswith("coach (terminal_c) is refused as referee (drop_ball): referee's page (gateway_a)")


def test_a_second_referee_that_repeats_its_request_is_reported_once(rig: Any) -> None:
    events = rig.listen(EVENT)
    act(rig, ActionName.DROP_BALL, PAGE)
    for _ in range(5):
        assert not act(rig, ActionName.DROP_BALL, TERMINAL).accepted
    assert sum("is refused" in event.text for event in events.all()) == 1


@pytest.mark.parametrize("action", [name for name in ActionName if name not in FREE])
def test_only_a_stop_and_what_coaches_may_request_need_no_seat(action: ActionName) -> None:
    chair = RefereeSeat()
    assert chair.refusal(RefereeAction(action=ActionName.START, **PAGE)) is None
    assert chair.refusal(RefereeAction(action=action, **OTHER)) is not None
    assert all(chair.refusal(RefereeAction(action=free, **OTHER)) is None for free in FREE)


@pytest.mark.parametrize("action", FREE)
def test_such_a_request_takes_no_seat(action: ActionName) -> None:
    chair = RefereeSeat()
    assert chair.refusal(RefereeAction(action=action, **PAGE)) is None
    assert chair.holder is None and not chair.pop_changes()


def test_a_referee_takes_over_and_the_one_before_is_refused(rig: Any) -> None:
    events = rig.listen(EVENT)
    act(rig, ActionName.DROP_BALL, PAGE)
    taken = seat(rig, SeatOperation.TAKE, TERMINAL)
    assert taken.accepted and taken.holder == "coach (terminal_c)"
    assert act(rig, ActionName.DROP_BALL, TERMINAL).accepted
    assert not act(rig, ActionName.DROP_BALL, PAGE).accepted
    texts = [event.text for event in events.all() if event.rule == "referee_seat"]
    assert "coach (terminal_c) officiates in place of referee's page (gateway_a)" in texts


def test_a_referee_that_leaves_frees_the_seat_and_no_other_can_leave_for_it(rig: Any) -> None:
    act(rig, ActionName.DROP_BALL, PAGE)
    wrong = seat(rig, SeatOperation.LEAVE, TERMINAL)
    assert not wrong.accepted
    assert wrong.reason == "the seat is not held by coach (terminal_c)"
    assert seat(rig, SeatOperation.LEAVE, PAGE) == SeatReply(accepted=True, holder=None)
    assert act(rig, ActionName.DROP_BALL, TERMINAL).accepted
    assert seat(rig, SeatOperation.SHOW, {}).holder == "coach (terminal_c)"


def test_a_referee_whose_process_ends_frees_the_seat(rig: Any) -> None:
    gateway = rig.seat()
    gateway.declare_alive(PresenceKind.REFEREE, PAGE["referee"])
    act(rig, ActionName.DROP_BALL, PAGE)
    rig.ticks(1)
    assert not act(rig, ActionName.DROP_BALL, OTHER).accepted
    gateway.close()
    rig.ticks(1)
    assert act(rig, ActionName.DROP_BALL, OTHER).accepted


def test_people_with_the_same_credentials_are_one_referee(rig: Any) -> None:
    """Several pages of one gateway send their requests under its name."""
    assert act(rig, ActionName.DROP_BALL, PAGE).accepted
    assert act(rig, ActionName.DROP_BALL, PAGE | {"source": "program of the referee"}).accepted


def test_a_box_takes_the_seat_of_people_by_connecting_and_frees_it_when_it_is_gone(rig: Any) -> None:
    events = rig.listen(EVENT)
    act(rig, ActionName.DROP_BALL, PAGE)
    station = rig.seat()
    station.declare_alive(REFBOX, "cyan")
    rig.ticks(1)
    assert act(rig, ActionName.DROP_BALL, PAGE).reason == BOX_DECIDES
    assert not seat(rig, SeatOperation.TAKE, PAGE).accepted
    station.withdraw_alive(REFBOX, "cyan")
    rig.ticks(1)
    assert act(rig, ActionName.DROP_BALL, OTHER).accepted
    texts = [event.text for event in events.all() if event.rule == "referee_seat"]
    assert "a league's referee box takes the seat of referee's page (gateway_a)" in texts


def test_a_second_box_is_refused_and_two_base_stations_of_one_box_are_one_referee(rig: Any) -> None:
    for side in Side:
        rig.seat().declare_alive(REFBOX, side.value)
    assert act(rig, ActionName.CORNER, FIRST_BOX, side=Side.CYAN).accepted
    assert act(rig, ActionName.CORNER, FIRST_BOX, side=Side.MAGENTA).accepted
    refused = act(rig, ActionName.CORNER, SECOND_BOX, side=Side.CYAN)
    assert not refused.accepted
    assert refused.reason == "refbox (box_10_0_0_5_28097) officiates; disconnect one of the two boxes"
    assert not act(rig, ActionName.STOP, SECOND_BOX).accepted


def test_clients_that_give_no_name_are_one_referee(rig: Any) -> None:
    unnamed = {"source": "coach"}
    assert act(rig, ActionName.DROP_BALL, unnamed).accepted
    assert act(rig, ActionName.DROP_BALL, unnamed).accepted
    assert act(rig, ActionName.DROP_BALL, PAGE).reason.startswith("coach (unnamed) officiates")


@pytest.mark.parametrize("operation", [SeatOperation.TAKE, SeatOperation.LEAVE])
def test_a_referee_without_a_name_neither_takes_nor_leaves_the_seat(operation: SeatOperation) -> None:
    reply = RefereeSeat().handle(SeatRequest(operation=operation))
    assert reply == SeatReply(accepted=False, reason=f"{operation} needs the name of a referee")


def test_a_flood_of_invented_names_does_not_fill_the_memory() -> None:
    chair = RefereeSeat()
    chair.refusal(RefereeAction(action=ActionName.START, **PAGE))
    for number in range(1000):
        chair.refusal(RefereeAction(action=ActionName.START, referee=f"flood_{number}"))
    assert len(chair.pop_changes()) == 101


def test_the_recorded_actions_have_no_names_of_connections(rig: Any) -> None:
    applied = rig.listen(APPLIED)
    act(rig, ActionName.DROP_BALL, PAGE)
    recorded: list[Applied] = [one for one in applied.all() if one.actions]
    assert [(action.source, action.referee) for one in recorded for action in one.actions] == [("referee's page", None)]


def test_names_of_referees_are_names_on_the_bus() -> None:
    for name in (gateway_name("5f0c6e1d"), terminal_name(), box_name("fe80::1%eth0.example.org", 28097)):
        assert RefereeAction(action=ActionName.START, referee=name).referee == name
    assert terminal_name() == terminal_name()
    names = {box_name(f"box-of-field-{field}.the-tournament.example.org", port) for field in "ab" for port in (1, 2)}
    assert len(names) == 4
