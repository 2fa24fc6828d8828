"""What can be asked of a running host."""

import pytest

from schemas.bus.contract import NoAnswerError
from schemas.coach import CoachOrder
from schemas.game import REFBOX, ActionName, ActionReply, Phase, RefereeAction
from schemas.host import SetupRequest
from schemas.parameters import ParameterDeed, ParametersRequest
from schemas.side import Side
from schemas.topics import ACTION, APPLIED, EVENT, INVALID, PARAMETERS, SETUP, STATE


def ask(pitch, action, side=None) -> ActionReply:
    """The referee's answer, given in the next tick."""
    answer = pitch.outside.ask(ACTION, RefereeAction(action=action, side=side))
    pitch.ticks(1)
    return answer.result(0.0)


@pytest.mark.parametrize("stage", ["pitch", "live"])
def test_an_action_is_answered_in_the_next_tick(stage, request):
    pitch = request.getfixturevalue(stage)
    states = pitch.hear(STATE)
    pitch.ticks(2)
    reply = ask(pitch, ActionName.STOP)
    said = states.all()[-1]
    assert said.phase is Phase.STOPPED
    assert reply == ActionReply(accepted=True, tick=said.tick)
    again = ask(pitch, ActionName.STOP)
    assert not again.accepted
    assert "the game is stopped already" in again.reason
    assert not ask(pitch, ActionName.CORNER).accepted
    assert ask(pitch, ActionName.CORNER, Side.MAGENTA).accepted


def test_actions_of_one_tick_are_answered_each_with_its_own_reply(pitch):
    pitch.ticks(2)
    first, second = (pitch.outside.ask(ACTION, RefereeAction(action=ActionName.STOP)) for _ in range(2))
    pitch.ticks(1)
    assert (first.result(0.0).accepted, second.result(0.0).accepted) == (True, False)


def test_while_a_referee_box_is_connected_nobody_else_may_more_than_stop_the_game(pitch):
    """Reference 8.3: manual buttons are disabled while the box is connected, and the space bar always stops."""
    ask(pitch, ActionName.STOP)
    box = pitch.seat()
    box.declare_alive(REFBOX, "cyan")
    by_hand, from_box = (
        pitch.outside.ask(ACTION, RefereeAction(action=ActionName.CORNER, side=Side.CYAN, source=source))
        for source in ("page", REFBOX)
    )
    pitch.ticks(1)
    assert "referee box is connected" in by_hand.result(0.0).reason
    assert from_box.result(0.0).accepted
    pitch.ticks(100)
    assert ask(pitch, ActionName.STOP).accepted
    box.withdraw_alive(REFBOX, "cyan")
    pitch.ticks(1)
    assert ask(pitch, ActionName.START).accepted


def test_a_question_that_is_none_is_told_and_answered_with_what_is_wrong(pitch):
    told = pitch.hear(INVALID)
    answer = pitch.outside.ask(ACTION, CoachOrder(sequence=1))
    pitch.ticks(1)
    with pytest.raises(NoAnswerError, match="RefereeAction: "):
        answer.result(0.0)
    (invalid,) = told.all()
    assert invalid.key == "game/action"


def test_the_setup_is_told_before_the_first_tick_and_during_the_match(pitch_of):
    pitch = pitch_of(patience={"attendance": 0})
    answer = pitch.outside.ask(SETUP, SetupRequest())
    pitch.begin()
    pitch.ticks(1)
    setup = answer.result(0.0)
    assert setup.teams[Side.CYAN].robots == ["cyan1", "cyan2"]


def test_the_setup_is_told_to_a_robot_that_has_to_know_it_before_it_can_answer(pitch):
    pitch.agents["cyan2"].frozen = True
    answer = pitch.outside.ask(SETUP, SetupRequest())

    def ask_first():
        if pitch.agents["cyan2"].frozen:
            try:
                answer.result(0.0)
            except NoAnswerError:
                return
            pitch.agents["cyan2"].frozen = False

    pitch.idle.append(ask_first)
    pitch.ticks(1)
    assert [given.answers_tick for given in pitch.inputs("cyan2")] == [0]


def test_a_start_begins_the_match_though_nobody_has_come(pitch_of):
    pitch = pitch_of()
    answer = pitch.outside.ask(ACTION, RefereeAction(action=ActionName.START))
    pitch.begin()
    pitch.ticks(1)
    assert answer.result(0.0).accepted
    assert pitch.host.simulation.state.phase is not Phase.PRE_GAME
    assert pitch.clock.now() < 1.0


def test_an_action_after_the_match_is_refused(pitch_of):
    pitch = pitch_of(duration=1)
    pitch.join_all()
    pitch.begin()
    while not pitch.host.simulation.over:
        pitch.ticks(1)
    answer = pitch.outside.ask(ACTION, RefereeAction(action=ActionName.START))
    pitch.host.part()
    assert answer.result(0.0) == ActionReply(accepted=False, reason="the match is over")


def played(pitch):
    pitch.join_all()
    pitch.begin()
    while not pitch.host.simulation.over:
        pitch.ticks(1)
    return pitch


def test_after_full_time_the_host_stays_until_those_who_watch_can_have_heard_of_it(pitch_of):
    """A message that was lost shows half a second later, with the bus's heartbeat, and is fetched from the host."""
    pitch = played(pitch_of(duration=1))
    pitch.seat().declare_alive("coach", "page")
    began = pitch.clock.now()
    pitch.host.part()
    assert pitch.clock.now() - began > 0.5


@pytest.mark.parametrize("watched", [False, True])
def test_a_host_that_nobody_watches_or_that_is_told_to_leave_does_not_stay(pitch_of, watched):
    pitch = played(pitch_of(duration=1))
    if watched:
        pitch.seat().declare_alive("coach", "page")
        pitch.host.leave()
    began = pitch.clock.now()
    pitch.host.part()
    assert pitch.clock.now() == began


def test_a_parameter_is_changed_between_two_ticks_recorded_and_told_to_late_comers(pitch):
    events, applied = pitch.hear(EVENT), pitch.hear(APPLIED)
    pitch.ticks(2)
    values = {"drive.max_speed": 1.5}
    answer = pitch.outside.ask(PARAMETERS, ParametersRequest(deed=ParameterDeed.SET, values=values))
    late = pitch.outside.ask(SETUP, SetupRequest())
    pitch.ticks(1)
    assert [(one.name, one.value) for one in answer.result(0.0).parameters] == [("drive.max_speed", 1.5)]
    assert late.result(0.0).drive.max_speed == 1.5
    assert [message.parameters for message in applied.all()][-2:] == [{}, values]
    assert "operator sets drive.max_speed = 1.5" in [event.text for event in events.all()]


def test_parameters_are_read_after_the_match_and_not_changed(pitch_of):
    pitch = pitch_of(duration=1)
    pitch.join_all()
    pitch.begin()
    while not pitch.host.simulation.over:
        pitch.ticks(1)
    asked = [ParametersRequest(deed=deed, names=["ball"]) for deed in (ParameterDeed.GET, ParameterDeed.RESET)]
    read, changed = [pitch.outside.ask(PARAMETERS, request) for request in asked]
    pitch.host.part()
    assert read.result(0.0).accepted
    assert changed.result(0.0).reason == "the match is over"
