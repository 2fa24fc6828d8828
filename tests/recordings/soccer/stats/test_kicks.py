"""What becomes of kicks, each made by hand: who has the ball next and where it was going decide."""

import pytest

from recordings.soccer.stats.kicks import KickOutcome, KickRecord
from schemas.messages.command import KickMode
from schemas.side import Side
from schemas.soccer.game import Phase

AT_GOAL, PAST_GOAL, ELSEWHERE = (8.0, 0.0, 0.0), (8.0, 1.3, 0.0), (3.0, 4.0, 0.0)
"""Velocities from the centre mark: the goal is 11 m ahead and 2 m to 2.4 m wide."""


def only(script) -> KickRecord:
    (kick_record,) = script.figures().kicks
    return kick_record


def kick(script, speed=AT_GOAL, robot="cyan2", **said) -> None:
    script.shot(touches=[robot], kicked=robot, speed=speed, **said)
    script.shot(touches=[robot])  # the ball is still at the kicker's hull: that is no new touch
    script.rest(1)


def ends(script, how: str) -> None:
    """One way for a kick to end."""
    script.ball = (6.0, 0.5)
    match how:
        case "out":
            script.out()
        case "goal":
            script.goal(Side.CYAN, "cyan2")
        case "own goal":
            script.goal(Side.MAGENTA, "cyan2")
        case "whistle":
            script.shot(phase=Phase.STOPPED, running=False)
        case "end":
            script.rest()
        case robot:
            script.shot(touches=[robot])
            script.rest()
            script.out()


@pytest.mark.parametrize(
    ("speed", "how", "outcome", "by"),
    [
        (ELSEWHERE, "cyan1", KickOutcome.RECEIVED, "cyan1"),
        (ELSEWHERE, "magenta2", KickOutcome.LOST, "magenta2"),
        (ELSEWHERE, "out", KickOutcome.LOST, None),
        (ELSEWHERE, "goal", KickOutcome.GOAL, None),
        (ELSEWHERE, "cyan2", KickOutcome.KEPT, None),
        (ELSEWHERE, "whistle", KickOutcome.UNDECIDED, None),
        (ELSEWHERE, "end", KickOutcome.UNDECIDED, None),
        (ELSEWHERE, "own goal", KickOutcome.OWN_GOAL, None),
        (AT_GOAL, "goal", KickOutcome.GOAL, None),
        (AT_GOAL, "magenta1", KickOutcome.SAVED, "magenta1"),
        (AT_GOAL, "magenta2", KickOutcome.BLOCKED, "magenta2"),
        (AT_GOAL, "out", KickOutcome.MISSED, None),
        (AT_GOAL, "cyan1", KickOutcome.RECEIVED, "cyan1"),
        (AT_GOAL, "cyan2", KickOutcome.KEPT, None),
        (AT_GOAL, "whistle", KickOutcome.UNDECIDED, None),
        (PAST_GOAL, "out", KickOutcome.MISSED, None),
        (PAST_GOAL, "magenta1", KickOutcome.MISSED, "magenta1"),
        (PAST_GOAL, "magenta2", KickOutcome.BLOCKED, "magenta2"),
    ],
)
def test_a_kick_is_what_its_way_and_the_next_touch_make_of_it(script, speed, how, outcome, by) -> None:
    kick(script, speed)
    ends(script, how)
    kick_record = only(script)
    assert (kick_record.robot, kick_record.outcome, kick_record.by) == ("cyan2", outcome, by)
    assert kick_record.time == pytest.approx(0.1)


def test_a_shot_that_goes_in_off_the_keeper_is_a_goal_and_no_save(script) -> None:
    kick(script)
    script.shot(touches=["magenta1"])
    script.shot(touches=["magenta1"])
    script.goal(Side.CYAN, "magenta1")
    assert (only(script).outcome, only(script).by) == (KickOutcome.GOAL, "magenta1")
    assert script.figures().sides[Side.MAGENTA].saves == 0


@pytest.mark.parametrize(("off", "outcome"), [((), KickOutcome.BLOCKED), (("magenta1",), KickOutcome.SAVED)])
def test_while_the_goalkeeper_is_off_the_field_its_substitute_saves_shots(script, off, outcome) -> None:
    kick(script)
    script.shot(touches=["magenta2"], off=off)
    script.shot(touches=["cyan1"], off=off)
    assert (only(script).outcome, only(script).by) == (outcome, "magenta2")
    assert script.figures().sides[Side.MAGENTA].saves == len(off)


def test_a_save_is_decided_when_somebody_else_has_the_ball(script) -> None:
    kick(script)
    script.shot(touches=["magenta1"])
    script.shot(touches=["cyan1"])
    script.goal(Side.CYAN, "cyan1")
    assert only(script).outcome is KickOutcome.SAVED
    figures = script.figures()
    assert figures.sides[Side.MAGENTA].saves == 1
    assert [robot.saves for robot in figures.robots] == [0, 0, 1, 0]
    assert figures.sides[Side.CYAN].goals == 1 and figures.sides[Side.CYAN].kicks.goals == 0


def test_a_keeper_that_kicks_a_saved_ball_away_has_saved_it(script) -> None:
    kick(script)
    script.shot(touches=["magenta1"])
    kick(script, (-3.0, 3.0, 0.0), "magenta1")
    script.ball = (4.0, 3.0)
    script.shot(touches=["magenta2"])
    outcomes = [(kick_record.robot, kick_record.outcome) for kick_record in script.figures().kicks]
    assert outcomes == [("cyan2", KickOutcome.SAVED), ("magenta1", KickOutcome.RECEIVED)]


def test_a_pass_that_is_kicked_on_at_once_is_received_and_a_kick_of_its_own(script) -> None:
    kick(script, ELSEWHERE)
    script.ball = (3.0, 3.0)
    kick(script, ELSEWHERE, "cyan1")
    outcomes = [(kick_record.robot, kick_record.outcome, kick_record.by) for kick_record in script.figures().kicks]
    assert outcomes[0] == ("cyan2", KickOutcome.RECEIVED, "cyan1")


def test_touches_of_the_tick_of_the_kick_count_by_their_order(script) -> None:
    script.shot(touches=["magenta2", "cyan2"], kicked="cyan2", speed=ELSEWHERE)  # the opponent touched before the kick
    script.rest()
    script.shot(touches=["cyan2", "magenta2"], kicked="cyan2", speed=(-8.0, 0.0, 0.0))  # and here it came back off it
    first, second = script.figures().kicks
    assert (first.outcome, second.outcome, second.by) == (KickOutcome.KEPT, KickOutcome.BLOCKED, "magenta2")


def test_a_kick_while_the_game_is_stopped_is_none(script) -> None:
    script.shot(phase=Phase.STOPPED, running=False)
    kick(script)
    script.rest()
    assert script.figures().kicks == []


def test_a_shot_in_the_second_half_goes_the_other_way(script) -> None:
    script.shot(cyan_attacks=-1)
    script.rest(1)
    kick(script, (-8.0, 0.0, 0.0))
    ends(script, "out")
    assert only(script).outcome is KickOutcome.MISSED


def test_the_kick_of_a_restart_counts_from_start_on(script) -> None:
    script.shot(phase=Phase.KICK_OFF, running=True, side=Side.CYAN)
    script.rest(1)
    kick(script, ELSEWHERE)
    ends(script, "cyan1")
    assert only(script).outcome is KickOutcome.RECEIVED


def test_a_kick_record_has_mode_speed_and_place(script) -> None:
    script.ball = (1.0, -2.0)
    kick(script, (6.0, 0.0, 2.5), mode=KickMode.LOB)
    kick_record = only(script)
    assert (kick_record.mode, kick_record.x, kick_record.y, kick_record.speed) == (
        KickMode.LOB,
        1.0,
        -2.0,
        pytest.approx(6.5),
    )


def test_passes_and_shots_are_counted_by_robot_and_side(script) -> None:
    for robot, speed, how in (
        ("cyan2", ELSEWHERE, "cyan1"),
        ("cyan2", ELSEWHERE, "magenta2"),
        ("cyan1", AT_GOAL, "magenta1"),
        ("cyan1", AT_GOAL, "goal"),
        ("magenta2", (-8.0, 0.0, 0.0), "magenta1"),
    ):
        script.ball = (0.0, 0.0)
        script.shot(phase=Phase.PLAY, running=True)
        script.rest(1)
        kick(script, speed, robot)
        ends(script, how)
    figures = script.figures()
    cyan, magenta = (figures.sides[side].kicks for side in Side)
    assert (cyan.kicks, cyan.passes, cyan.passes_completed) == (4, 2, 1)
    assert (cyan.shots, cyan.shots_on_goal, cyan.goals) == (2, 2, 1)
    assert (magenta.passes, magenta.passes_completed, magenta.shots) == (1, 1, 0)
    assert [robot.kicks.passes for robot in figures.robots] == [0, 2, 0, 1]
    assert figures.sides[Side.MAGENTA].saves == 1


@pytest.mark.parametrize(("metres", "outcome"), [(0.95, KickOutcome.LOST), (1.05, KickOutcome.RECEIVED)])
def test_a_pass_is_received_at_least_a_metre_away(script, metres, outcome) -> None:
    kick(script, ELSEWHERE)
    script.ball = (metres, 0.0)
    script.shot(touches=["cyan1"])
    assert only(script).outcome is outcome
