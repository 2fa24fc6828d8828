"""What can be asked of a running host."""

import pytest

from runtime.bus.contract import NoReplyError
from schemas.messages.coach import CoachOrder
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from schemas.messages.setup import SetupRequest
from schemas.messages.soccer.game import ActionReply, RefereeAction
from schemas.side import Side
from schemas.soccer.game import REFBOX, ActionName, Phase
from schemas.topics import ACTION, APPLIED, EVENT, INVALID, PARAMETERS, SETUP, STATE


def ask(rig, action, side=None) -> ActionReply:
    """The referee's answer, given in the next tick."""
    answer = rig.outside.query(ACTION, RefereeAction(action=action, side=side))
    rig.ticks(1)
    return answer.result(0.0)


def played(rig):
    """The same rig with a match that has begun and is over."""
    rig.join_all()
    rig.begin()
    assert ask(rig, ActionName.END_GAME).accepted
    assert rig.host.simulation.over
    return rig


@pytest.mark.parametrize("rig_name", ["rig", "realtime_rig"])
def test_an_action_is_answered_in_the_next_tick(rig_name, request):
    rig = request.getfixturevalue(rig_name)
    states = rig.listen(STATE)
    rig.ticks(2)
    reply = ask(rig, ActionName.STOP)
    said = states.all()[-1]
    assert said.phase is Phase.STOPPED
    assert reply == ActionReply(accepted=True, tick=said.tick)
    again = ask(rig, ActionName.STOP)
    assert not again.accepted
    assert "the game is stopped already" in again.reason
    assert not ask(rig, ActionName.CORNER).accepted
    assert ask(rig, ActionName.CORNER, Side.MAGENTA).accepted


def test_actions_of_one_tick_are_answered_each_with_its_own_reply(rig):
    rig.ticks(2)
    first, second = (rig.outside.query(ACTION, RefereeAction(action=ActionName.STOP)) for _ in range(2))
    rig.ticks(1)
    assert (first.result(0.0).accepted, second.result(0.0).accepted) == (True, False)


def test_while_a_referee_box_is_connected_other_clients_may_only_stop_the_game(rig):
    """As in the NuBot coach: its buttons are disabled while the box is connected, and the space bar always stops."""
    ask(rig, ActionName.STOP)
    box = rig.seat()
    box.declare_alive(REFBOX, "cyan")
    by_hand, from_box = (
        rig.outside.query(ACTION, RefereeAction(action=ActionName.CORNER, side=Side.CYAN, source=source))
        for source in ("page", REFBOX)
    )
    rig.ticks(1)
    assert "referee box is connected" in by_hand.result(0.0).reason
    assert from_box.result(0.0).accepted
    rig.ticks(100)
    assert ask(rig, ActionName.STOP).accepted
    box.withdraw_alive(REFBOX, "cyan")
    rig.ticks(1)
    assert ask(rig, ActionName.START).accepted


def test_a_robot_that_the_referee_box_asks_for_may_be_named_though_everything_else_is_locked(rig):
    events, states = rig.listen(EVENT), rig.listen(STATE)
    ask(rig, ActionName.STOP)
    box = rig.seat()
    box.declare_alive(REFBOX, "cyan")
    card = RefereeAction(action=ActionName.RED_CARD, side=Side.CYAN, source=REFBOX)
    answers = [rig.outside.query(ACTION, card)]
    rig.ticks(1)
    (question,) = states.all()[-1].questions
    assert (question.action, question.side, question.robots) == (ActionName.RED_CARD, Side.CYAN, ["cyan1", "cyan2"])
    for action in (ActionName.RED_CARD, ActionName.NAME_ROBOT, ActionName.NAME_ROBOT):
        answers.append(rig.outside.query(ACTION, RefereeAction(action=action, robot="cyan1", source="cyan's coach")))
        rig.ticks(1)
    assert [answer.result(0.0).accepted for answer in answers] == [True, False, True, False]
    state = states.all()[-1]
    assert state.refbox and not state.questions and state.robots["cyan1"].red == 1
    told = [event.text for event in events.all()]
    assert "cyan's coach requests: name robot for cyan1" in told


def test_an_invalid_query_is_published_and_answered_with_the_reason(rig):
    told = rig.listen(INVALID)
    answer = rig.outside.query(ACTION, CoachOrder(sequence=1))
    rig.ticks(1)
    with pytest.raises(NoReplyError, match="RefereeAction: "):
        answer.result(0.0)
    (invalid,) = told.all()
    assert invalid.key == "game/action"


def test_the_setup_can_be_queried_before_the_first_tick_and_during_the_match(rig_of):
    rig = rig_of(patience={"attendance": 0})
    answer = rig.outside.query(SETUP, SetupRequest())
    rig.begin()
    rig.ticks(1)
    setup = answer.result(0.0)
    assert setup.teams[Side.CYAN].robots == ["cyan1", "cyan2"]


def test_the_setup_is_served_while_the_host_waits_for_a_robot_that_needs_it(rig):
    rig.agents["cyan2"].frozen = True
    answer = rig.outside.query(SETUP, SetupRequest())

    def ask_first():
        if rig.agents["cyan2"].frozen:
            try:
                answer.result(0.0)
            except NoReplyError:
                return
            rig.agents["cyan2"].frozen = False

    rig.idle.append(ask_first)
    rig.ticks(1)
    assert [given.answers_tick for given in rig.inputs("cyan2")] == [0]


def test_the_action_start_begins_the_match_without_any_agent(rig_of):
    rig = rig_of()
    answer = rig.outside.query(ACTION, RefereeAction(action=ActionName.START))
    rig.begin()
    rig.ticks(1)
    assert answer.result(0.0).accepted
    assert rig.host.simulation.state.phase is not Phase.PRE_GAME
    assert rig.clock.now() < 1.0


def test_an_action_after_the_match_is_refused(rig_of):
    rig = played(rig_of())
    answer = rig.outside.query(ACTION, RefereeAction(action=ActionName.START))
    rig.host.wait_for_recorders()
    assert answer.result(0.0) == ActionReply(accepted=False, reason="the match is over")


def test_after_full_time_the_host_stays_until_its_watchers_can_have_received_the_end(rig_of):
    """A message that was lost shows half a second later, with the bus's heartbeat, and is fetched from the host."""
    rig = played(rig_of())
    rig.seat().declare_alive("coach", "page")
    began = rig.clock.now()
    rig.host.wait_for_recorders()
    assert rig.clock.now() - began > 0.5


@pytest.mark.parametrize("watched", [False, True])
def test_a_host_without_watchers_or_with_a_stop_request_does_not_stay(rig_of, watched):
    rig = played(rig_of())
    if watched:
        rig.seat().declare_alive("coach", "page")
        rig.host.stop()
    began = rig.clock.now()
    rig.host.wait_for_recorders()
    assert rig.clock.now() == began


def test_a_parameter_is_changed_between_two_ticks_recorded_and_part_of_the_setup(rig):
    events, applied = rig.listen(EVENT), rig.listen(APPLIED)
    rig.ticks(2)
    values = {"drive.max_speed": 1.5}
    answer = rig.outside.query(PARAMETERS, ParametersRequest(operation=ParameterOperation.SET, values=values))
    late = rig.outside.query(SETUP, SetupRequest())
    rig.ticks(1)
    assert [(one.name, one.value) for one in answer.result(0.0).parameters] == [("drive.max_speed", 1.5)]
    assert late.result(0.0).drive.max_speed == 1.5
    assert [message.parameters for message in applied.all()][-2:] == [{}, values]
    assert "operator sets drive.max_speed = 1.5" in [event.text for event in events.all()]


def test_parameters_are_read_after_the_match_and_not_changed(rig_of):
    rig = played(rig_of())
    asked = [
        ParametersRequest(operation=operation, names=["ball"])
        for operation in (ParameterOperation.GET, ParameterOperation.RESET)
    ]
    read, changed = [rig.outside.query(PARAMETERS, request) for request in asked]
    rig.host.wait_for_recorders()
    assert read.result(0.0).accepted
    assert changed.result(0.0).reason == "the match is over"
