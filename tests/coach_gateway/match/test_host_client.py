import threading

import pytest

from coach_gateway.match.host_client import HostClient
from coach_gateway.match.orders import OrderStatus
from runtime.bus.contract import Bus, PresenceKind
from schemas.config.match_config import load_match
from schemas.errors import TouchlineError
from schemas.messages.coach import ActiveOrder, CoachMode, CoachOrder
from schemas.messages.soccer.game import ActionReply, RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName
from schemas.topics import ACTION, ACTIVE_ORDER, ORDER
from support.fake_host import FakeHost
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock

MICROSECONDS = 1_795_275_009_214_000
"""Since 1970: far beyond any clock in ms."""


@pytest.fixture
def medium() -> SharedState:
    return SharedState()


def seat(medium: SharedState) -> Bus:
    return medium.open_bus("friendly", SteppedClock())


@pytest.fixture
def host(medium: SharedState):
    """Answers how the match is set up, and refuses every action but `stop`; gives the actions it was asked for.

    Magenta has an order already, of a program whose clock counts in microseconds.
    """

    def answer(action: RefereeAction) -> ActionReply:
        accepted = action.action is ActionName.STOP
        return ActionReply(accepted=accepted, reason="" if accepted else "play is running")

    match = load_match(None, {f"teams.{side}.size": 2 for side in Side})
    host = FakeHost(medium, match, {ACTION: answer}, clock=SteppedClock(), in_threads=True)
    host.setup = host.setup.replace(orders={Side.MAGENTA: MICROSECONDS})
    yield host.asked
    host.close()


@pytest.fixture
def gateway(medium: SharedState, host: list[RefereeAction]) -> HostClient:
    return HostClient(seat(medium))


def test_what_a_host_refuses_to_read_has_its_reason_and_no_other_remedy(medium: SharedState) -> None:
    """As of a program of another version, whose match has the right name."""
    server = seat(medium).serve(ACTION)
    answering = threading.Thread(target=lambda: server.mailbox.get(5.0).fail("version 1.0 is not read"))
    answering.start()
    with pytest.raises(TouchlineError, match=r'^match "friendly": version 1\.0 is not read$'):
        HostClient(seat(medium)).act(RefereeAction(action=ActionName.STOP))
    answering.join()


def test_an_action_reaches_the_referee_and_its_answer_comes_back(
    gateway: HostClient, host: list[RefereeAction]
) -> None:
    assert gateway.act(RefereeAction(action=ActionName.STOP)).accepted
    refused = gateway.act(RefereeAction(action=ActionName.CORNER, side=Side.MAGENTA))
    assert (refused.accepted, refused.reason) == (False, "play is running")
    assert [(action.action, action.side) for action in host] == [
        (ActionName.STOP, None),
        (ActionName.CORNER, Side.MAGENTA),
    ]


def test_all_requests_of_one_connection_are_of_one_referee_that_is_present_with_it(
    medium: SharedState, host: list[RefereeAction]
) -> None:
    watch, first, second = seat(medium).watch_alive(), seat(medium), seat(medium)
    for client in (HostClient(first), HostClient(first), HostClient(second)):
        client.act(RefereeAction(action=ActionName.STOP))
    page, program, other = (action.referee for action in host)
    assert page == program != other
    first.close()
    seen = [presence for presence in iter(watch.receive, None) if presence.kind is PresenceKind.REFEREE]
    assert [(one.name, one.alive) for one in seen] == [(page, True), (other, True), (page, False)]


def test_an_action_without_a_host_names_the_match_and_what_to_do(medium: SharedState) -> None:
    with pytest.raises(TouchlineError, match=r'match "friendly": no process answers game/action; name the match'):
        HostClient(seat(medium)).act(RefereeAction(action=ActionName.STOP))


def test_orders_go_to_their_side_alone_and_each_has_a_higher_number(gateway: HostClient, medium: SharedState) -> None:
    listener = seat(medium)
    cyan, magenta = listener.subscribe(ORDER, side="cyan"), listener.subscribe(ORDER, side="magenta")
    first = gateway.order(Side.CYAN, mode=CoachMode.HOLD, max_speed=1.5)
    second = gateway.order(Side.CYAN)
    received = [cyan.receive(), cyan.receive()]
    orders: list[CoachOrder] = [one.message() for one in received if one is not None]
    assert orders == [first, second]
    assert (first.mode, first.max_speed) == (CoachMode.HOLD, 1.5)
    assert second.sequence > first.sequence >= 1
    assert magenta.receive() is None


def test_an_order_of_a_later_process_counts_more_than_one_of_an_earlier_process(
    medium: SharedState, host: list[RefereeAction]
) -> None:
    sequences = []
    for moment in (1000.0, 1000.5):
        clock = SteppedClock()
        clock.sleep_until(moment)
        sequences.append(HostClient(medium.open_bus("friendly", clock)).order(Side.CYAN).sequence)
    assert sequences[0] < sequences[1]


def test_an_order_about_a_robot_of_the_other_side_is_refused_with_a_hint(gateway: HostClient) -> None:
    with pytest.raises(TouchlineError, match='robot_a is "cyan7", no robot of cyan; did you mean "cyan'):
        gateway.order(Side.CYAN, robot_a="cyan7")


def test_an_order_that_contradicts_itself_is_refused_with_the_reason(gateway: HostClient) -> None:
    with pytest.raises(TouchlineError, match="the order cannot be given: the test move needs robot_a and point_a"):
        gateway.order(Side.CYAN, mode=CoachMode.TEST, test="move")


def test_an_order_is_numbered_after_the_active_one_whatever_the_clock_has(
    gateway: HostClient, medium: SharedState
) -> None:
    gateway.orders.update()
    ahead = CoachOrder(sequence=4_000_000_000_000)
    standing = ActiveOrder(tick=1, time=0.02, order=ahead, acknowledged={"cyan1": True})
    seat(medium).publisher(ACTIVE_ORDER, side="cyan").put(standing)
    assert gateway.order(Side.CYAN).sequence == ahead.sequence + 1


def test_a_new_coach_goes_on_from_the_number_of_the_active_order_however_large(gateway: HostClient) -> None:
    first = gateway.order(Side.MAGENTA)
    assert first.sequence == MICROSECONDS + 1
    assert first.refusal_after(CoachOrder(sequence=MICROSECONDS)) == ""


class AnsweringClock(SteppedClock):
    """Has another robot acknowledge whenever the clock is waited on."""

    __slots__ = ("say",)

    def sleep_until(self, moment: float) -> None:
        super().sleep_until(moment)
        self.say()


def test_robots_are_waited_for_until_all_have_acknowledged_or_patience_ends(
    medium: SharedState, host: list[RefereeAction]
) -> None:
    clock = AnsweringClock()
    gateway = HostClient(medium.open_bus("friendly", clock))
    given = gateway.order(Side.CYAN, mode=CoachMode.HOLD)
    writer = seat(medium).publisher(ACTIVE_ORDER, side="cyan")
    heard = {"cyan1": False, "cyan2": False}

    def say() -> None:
        writer.put(ActiveOrder(tick=1, time=0.02, order=given, acknowledged=heard))
        heard["cyan1"] = True
        heard["cyan2"] = clock.now() > 1.0

    clock.say = say
    assert gateway.wait_for_robots(Side.CYAN, given, patience=0.5).missing == ("cyan2",)
    receipt = gateway.wait_for_robots(Side.CYAN, given, patience=5.0)
    assert (receipt.status, receipt.missing) == (OrderStatus.ACTIVE, ())
    assert clock.now() < 2.0
