"""The actions: what each does, and when it is refused, with the reason."""

import pytest

from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName, EventKind, Phase, Point, Score
from sim_host.soccer.referee.actions import ACTIONS

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA


def test_every_action_has_its_row():
    assert set(ACTIONS) == set(ActionName)


def refused(ruling):
    (reply,) = ruling.replies
    assert not reply.accepted and reply.reason
    assert not any(event.kind is EventKind.ACTION for event in ruling.events)
    return reply.reason


@pytest.mark.parametrize(
    ("name", "side", "place", "why"),
    [
        ("start", None, None, "running"),
        ("free_kick", None, None, "no side"),
        ("goal", None, None, "no side"),
        ("drop_ball", CYAN, None, "cyan"),
        ("penalty", CYAN, (1.0, 1.0), "penalty is fixed"),
        ("kick_off", CYAN, (1.0, 1.0), "kick-off is fixed"),
        ("free_kick", CYAN, (40.0, 0.0), "outside the field"),
        ("place_ball", None, (1.0, 1.0), "running"),
    ],
)
def test_in_play_an_action_that_makes_no_sense_is_refused_with_its_reason(rig, name, side, place, why):
    rig.playing()
    before = rig.state
    assert why in refused(rig.ask(name, side, place))
    assert rig.state.phase is Phase.PLAY and rig.state.score == before.score


@pytest.mark.parametrize("name", ["stop", "free_kick", "goal", "end_half", "place_ball", "drop_ball"])
def test_before_the_match_only_start_kick_off_and_the_end_are_allowed(new_rig, name):
    rig = new_rig(automatic=False)
    side = CYAN if name in ("free_kick", "goal") else None
    assert "pre_game" in refused(rig.ask(name, side, (1.0, 1.0) if name == "place_ball" else None))


@pytest.mark.parametrize("name", [name.value for name in ActionName])
def test_after_full_time_everything_is_refused(rig, name):
    rig.ask("end_game")
    assert rig.state.phase is Phase.FULL_TIME
    refused(rig.ask(name, CYAN, (1.0, 1.0) if name == "place_ball" else None))


def test_a_cancelled_goal_leaves_the_score_and_nothing_else_changes(rig):
    rig.playing()
    rig.ask("goal", MAGENTA)
    before = rig.state
    ruling = rig.ask("cancel_goal", MAGENTA)
    assert ruling.replies[0].accepted and rig.state.score == Score()
    assert (rig.state.phase, rig.state.pending) == (before.phase, before.pending)
    assert [event.score for event in ruling.events if event.kind is EventKind.NO_GOAL] == [Score()]
    assert "magenta has no goal" in refused(rig.ask("cancel_goal", MAGENTA))


def test_stop_halts_at_once_and_waits_for_people(rig):
    rig.playing()
    ruling = rig.ask("stop")
    assert ruling.replies[0].accepted and not ruling.state.running and ruling.state.phase is Phase.STOPPED
    rig.run(30.0)
    assert rig.state.phase is Phase.STOPPED
    assert "already" in refused(rig.ask("stop"))


def test_start_after_stop_drops_the_ball_where_it_lies(rig):
    rig.playing((2.0, 1.0))
    rig.ask("stop")
    rig.ask("start")
    assert rig.state.phase is Phase.DROP_BALL and rig.state.spot == (2.0, 1.0)


def test_start_after_a_stop_before_the_half_began_signals_its_kick_off_again(rig):
    rig.until(lambda state: state.phase is Phase.KICK_OFF)
    rig.ask("stop")
    rig.ask("start")
    assert rig.state.phase is Phase.KICK_OFF and rig.state.side is CYAN


def test_start_signals_a_restart_that_is_due_and_then_gives_start(rig):
    rig.playing()
    rig.ask("free_kick", MAGENTA, (0.5, 3.0))
    assert len(rig.ask("start").placements) == 1
    assert rig.state.phase is Phase.FREE_KICK and not rig.state.running
    rig.tick()
    rig.ask("start")
    assert rig.state.phase is Phase.FREE_KICK and rig.state.running


def test_start_is_refused_while_the_ball_is_not_on_its_spot(rig):
    rig.until(lambda state: state.phase is Phase.KICK_OFF)
    rig.ball = (1.0, 0.0, rig.radius)
    assert "1.00 m from its spot" in refused(rig.ask("start"))


def test_start_in_the_break_begins_the_next_half(rig):
    rig.playing()
    rig.ask("end_half")
    rig.ask("start")
    assert rig.state.half == 2 and rig.state.phase is Phase.KICK_OFF


def test_kick_off_before_the_match_begins_it_with_that_side(new_rig):
    rig = new_rig(automatic=False)
    rig.ask("kick_off", MAGENTA)
    assert (rig.state.phase, rig.state.side) == (Phase.KICK_OFF, MAGENTA)
    rig.playing()
    rig.ask("end_half")
    rig.until(lambda state: state.phase is Phase.KICK_OFF)
    assert rig.state.side is CYAN


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize(
    "phase", [Phase.KICK_OFF, Phase.FREE_KICK, Phase.GOAL_KICK, Phase.THROW_IN, Phase.CORNER, Phase.PENALTY]
)
def test_a_restart_that_is_ordered_stops_the_game_and_is_played_at_its_spot(rig, phase, side):
    rig.playing((2.0, 1.0))
    rig.ask(phase.value, side)
    assert rig.state.phase is Phase.STOPPED
    rig.until(lambda state: state.phase is phase)
    pitch, numbers, attack = rig.pitch, rig.book.restarts, side.attack(1)
    mark = pitch.goal_line - pitch.penalty_mark
    spots = {
        Phase.KICK_OFF: (0.0, 0.0),
        Phase.FREE_KICK: (2.0, 1.0),
        Phase.GOAL_KICK: (-attack * mark, 0.0),
        Phase.THROW_IN: (2.0, pitch.touch_line - numbers.touch_line_inset),
        Phase.CORNER: (attack * (pitch.goal_line - numbers.corner_inset), pitch.touch_line - numbers.corner_inset),
        Phase.PENALTY: (attack * mark, 0.0),
    }
    assert rig.state.side is side and rig.state.spot == pytest.approx(spots[phase])
    assert rig.ball[:2] == pytest.approx(spots[phase])


def test_an_ordered_restart_takes_the_place_of_the_one_that_is_due(rig):
    rig.crossing((1.0, rig.pitch.touch_line), (1.0, rig.pitch.touch_line + 0.3))
    ruling = rig.ask("free_kick", CYAN, (0.5, 0.5))
    assert [event.kind for event in ruling.events] == [EventKind.ACTION]
    rig.until(lambda state: state.phase is not Phase.STOPPED)
    assert (rig.state.phase, rig.state.side, rig.state.spot) == (Phase.FREE_KICK, CYAN, (0.5, 0.5))


def test_place_ball_moves_the_spot_of_a_signalled_restart_and_gives_time_again(rig):
    rig.playing()
    rig.ask("free_kick", CYAN)
    rig.until(lambda state: state.phase is Phase.FREE_KICK)
    rig.run(rig.book.restarts.signal_to_start - 0.1)
    rig.ask("place_ball", place=(0.5, 2.0))
    assert rig.state.spot == (0.5, 2.0) and rig.ball[:2] == (0.5, 2.0)
    rig.run(rig.book.restarts.signal_to_start - 0.1)
    assert not rig.state.running


def test_place_ball_then_start_in_one_tick_drops_it_at_the_new_place(rig):
    rig.playing((2.0, 1.0))
    rig.ask("stop")
    there = Point(x=-1.0, y=2.0)
    rig.tick(actions=[RefereeAction(action="place_ball", place=there), RefereeAction(action="start")])
    assert rig.state.phase is Phase.DROP_BALL and rig.state.spot == (-1.0, 2.0)


def test_place_ball_needs_a_place_and_a_spot_that_is_free_to_move(rig):
    rig.until(lambda state: state.phase is Phase.KICK_OFF)
    assert "no place" in refused(rig.ask("place_ball"))
    assert "kick-off is fixed" in refused(rig.ask("place_ball", place=(1.0, 1.0)))


def test_a_goal_by_word_counts_and_the_other_side_kicks_off(rig):
    rig.playing()
    ruling = rig.ask("goal", MAGENTA, robot="magenta3")
    assert ruling.state.score == Score(magenta=1)
    assert [event.kind for event in ruling.events] == [EventKind.ACTION, EventKind.GOAL, EventKind.STOP]
    rig.until(lambda state: state.phase is Phase.KICK_OFF)
    assert rig.state.side is CYAN


def test_a_goal_by_a_robot_that_does_not_play_is_refused(rig):
    rig.playing()
    assert "zebra9" in refused(rig.ask("goal", MAGENTA, robot="zebra9"))


def test_each_action_of_a_tick_gets_its_own_reply_in_order(rig):
    rig.playing()
    ruling = rig.tick(
        actions=[RefereeAction(action="start"), RefereeAction(action="stop"), RefereeAction(action="stop")]
    )
    assert [reply.accepted for reply in ruling.replies] == [False, True, False]
