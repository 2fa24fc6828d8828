"""Who decides: automatic, manual and mixed officiating, and undo."""

import pytest

from schemas.side import Side
from schemas.soccer.game import EventKind, OfficiatingMode, Phase, Score

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA


def out(rig):
    """In play, the ball crosses the touch line; it stays there."""
    touch = rig.pitch.touch_line
    return rig.crossing((1.0, touch - 0.1), (1.0, touch + 0.3), ["cyan2"])


def begun(rig):
    """The match is started by word and the kick-off, too."""
    rig.ask("start")
    rig.tick()
    rig.ask("start")
    return rig


@pytest.fixture
def manual(new_rig):
    return begun(new_rig(mode=OfficiatingMode.MANUAL, automatic=False, duration=60.0))


@pytest.fixture
def mixed(new_rig):
    return new_rig(mode=OfficiatingMode.MIXED, proposal=2.0)


def scored(rig):
    line = rig.pitch.goal_line
    return rig.crossing((line - 0.1, 0.0), (line + 0.3, 0.0), ["cyan3"])


def test_in_manual_officiating_nothing_is_judged_but_the_clock(manual):
    assert scored(manual).events == () and manual.state.phase is Phase.PLAY
    manual.run(3.0)
    assert manual.state.score == Score() and manual.state.running
    manual.until(lambda state: state.phase is Phase.PARKING)
    assert manual.state.clock == pytest.approx(30.0)


def test_in_manual_officiating_the_ball_is_placed_and_start_is_for_people_to_give(manual):
    manual.playing()
    manual.ask("goal", CYAN)
    manual.until(lambda state: state.phase is Phase.KICK_OFF)
    assert manual.state.score == Score(cyan=1) and manual.ball[:2] == (0.0, 0.0)
    manual.run(20.0)
    assert not manual.state.running
    manual.ask("start")
    assert manual.state.running


def test_in_mixed_officiating_a_decision_is_proposed_and_carried_out_in_time(mixed):
    ruling = out(mixed)
    (event,) = ruling.events
    assert (event.kind, event.rule) == (EventKind.PROPOSAL, "touch_line") and mixed.state.running
    assert "touch_line" in mixed.state.game_state(1, 0.0).proposal
    mixed.run(1.9)
    assert mixed.state.running
    mixed.run(0.12)
    assert mixed.state.pending.phase is Phase.THROW_IN and mixed.state.pending.side is MAGENTA
    assert mixed.state.proposal is None


def test_a_proposal_that_is_confirmed_is_carried_out_at_once(mixed):
    scored(mixed)
    assert mixed.state.score == Score()
    mixed.ask("confirm")
    assert mixed.state.score == Score(cyan=1) and mixed.state.pending.phase is Phase.KICK_OFF


def test_a_proposal_that_is_overruled_is_not_carried_out(mixed):
    scored(mixed)
    mixed.ask("overrule")
    assert mixed.state.proposal is None
    mixed.ball = (1.0, 0.0, mixed.radius)
    mixed.run(5.0)
    assert mixed.state.score == Score() and mixed.state.phase is Phase.PLAY


def test_a_stalled_ball_is_proposed_again_only_after_its_whole_time(mixed):
    mixed.playing()
    mixed.velocity = (0.0, 0.0, 0.0)
    limit = mixed.book.stall.still_duration
    for _ in range(2):
        mixed.run(limit - 0.1)
        assert mixed.state.proposal is None
        mixed.run(0.2)
        mixed.ask("overrule")


def test_a_stop_by_people_settles_what_was_proposed(mixed):
    out(mixed)
    mixed.ask("free_kick", CYAN)
    mixed.run(3.0)
    assert mixed.state.proposal is None and mixed.state.phase is Phase.FREE_KICK


@pytest.mark.parametrize("name", ["confirm", "overrule"])
def test_where_nothing_is_proposed_there_is_nothing_to_say(mixed, name):
    mixed.playing()
    (reply,) = mixed.ask(name).replies
    assert not reply.accepted and "there is no proposal" in reply.reason


def test_the_end_of_a_half_is_no_proposal(new_rig):
    rig = new_rig(mode=OfficiatingMode.MIXED, proposal=2.0, duration=20.0)
    rig.playing()
    rig.until(lambda state: state.phase is Phase.PARKING)
    assert rig.state.clock == pytest.approx(10.0)


def test_undo_of_a_goal_brings_the_score_back_and_drops_the_ball_where_play_was(rig):
    scored(rig)
    clock = rig.state.clock
    rig.run(1.0)
    ruling = rig.ask("undo")
    assert ruling.replies[0].accepted and rig.state.score == Score()
    assert rig.state.clock == pytest.approx(clock + 1.02)
    assert rig.state.phase is Phase.STOPPED and rig.state.pending.phase is Phase.DROP_BALL
    rig.until(lambda state: state.phase is Phase.PLAY)


def test_decisions_are_undone_one_after_another_and_no_further_than_the_first(rig):
    rig.playing()
    rig.ask("stop")
    rig.ask("yellow_card", robot="magenta1")
    for goals in (1, 2):
        rig.ask("goal", CYAN)
        assert rig.state.score.cyan == goals
    for goals in (1, 0):
        assert rig.ask("undo").replies[0].accepted
        assert rig.state.score.cyan == goals
    assert rig.state.participation.cards != {}
    assert rig.ask("undo").replies[0].accepted
    assert rig.state.participation.cards == {}
    while (reply := rig.ask("undo").replies[0]).accepted:
        pass
    assert "no decision can be undone" in reply.reason


def test_undo_of_a_restart_that_was_ordered_signals_the_one_before_again(rig):
    rig.until(lambda state: state.phase is Phase.KICK_OFF)
    rig.ask("free_kick", MAGENTA, (1.0, 1.0))
    rig.until(lambda state: state.phase is Phase.FREE_KICK)
    rig.ask("undo")
    assert (rig.state.phase, rig.state.side, rig.ball[:2]) == (Phase.KICK_OFF, CYAN, (0.0, 0.0))


def test_undo_of_a_red_card_sets_the_robot_on_the_field_again(rig):
    rig.playing()
    rig.ask("stop")
    rig.ask("red_card", robot="magenta1")
    rig.ask("undo")
    assert rig.state.participation.absences == {} and rig.state.participation.cards == {}
    assert abs(rig.robots["magenta1"][1]) <= rig.pitch.touch_line
    assert rig.state.phase is Phase.STOPPED


def test_a_half_that_was_ended_by_mistake_goes_on_and_one_whose_time_is_up_does_not(new_rig):
    rig = new_rig(duration=60.0)
    rig.playing()
    rig.ask("end_half")
    assert rig.ask("undo").replies[0].accepted and rig.state.half == 1
    rig.until(lambda state: state.phase is Phase.PARKING)
    (reply,) = rig.ask("undo").replies
    assert not reply.accepted and "time is up" in reply.reason


def test_what_was_decided_in_the_other_half_is_settled(rig):
    scored(rig)
    rig.ask("end_half")
    rig.until(lambda state: state.half == 2)
    assert not rig.ask("undo").replies[0].accepted


def test_a_state_remembers_twenty_states_without_what_they_remember(rig):
    rig.playing()
    for _ in range(25):
        rig.ask("goal", CYAN)
    assert len(rig.state.history) == 20
    assert all(state.history == () for state in rig.state.history)
