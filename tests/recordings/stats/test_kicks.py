"""What becomes of kicks, each made by hand: who has the ball next and where it was going decide."""

import pytest

from recordings.stats.kicks import KickStory, Outcome
from schemas.command import KickMode
from schemas.game import Phase
from schemas.side import Side

AT_GOAL, PAST_GOAL, ELSEWHERE = (8.0, 0.0, 0.0), (8.0, 1.3, 0.0), (3.0, 4.0, 0.0)
"""Velocities from the centre mark: the goal is 11 m ahead and 2 m to 2.4 m wide."""


def only(film) -> KickStory:
    (story,) = film.figures().kicks
    return story


def kick(film, speed=AT_GOAL, robot="cyan2", **said) -> None:
    film.shot(touches=[robot], kicked=robot, speed=speed, **said)
    film.shot(touches=[robot])  # the ball is still at the kicker's hull: that is no new touch
    film.rest(1)


def ends(film, how: str) -> None:
    """One way for a kick to end."""
    film.ball = (6.0, 0.5)
    match how:
        case "out":
            film.out()
        case "goal":
            film.goal(Side.CYAN, "cyan2")
        case "own goal":
            film.goal(Side.MAGENTA, "cyan2")
        case "whistle":
            film.shot(phase=Phase.STOPPED, running=False)
        case "end":
            film.rest()
        case robot:
            film.shot(touches=[robot])
            film.rest()
            film.out()


@pytest.mark.parametrize(
    ("speed", "how", "outcome", "by"),
    [
        (ELSEWHERE, "cyan1", Outcome.RECEIVED, "cyan1"),
        (ELSEWHERE, "magenta2", Outcome.LOST, "magenta2"),
        (ELSEWHERE, "out", Outcome.LOST, None),
        (ELSEWHERE, "goal", Outcome.GOAL, None),
        (ELSEWHERE, "cyan2", Outcome.KEPT, None),
        (ELSEWHERE, "whistle", Outcome.UNDECIDED, None),
        (ELSEWHERE, "end", Outcome.UNDECIDED, None),
        (ELSEWHERE, "own goal", Outcome.OWN_GOAL, None),
        (AT_GOAL, "goal", Outcome.GOAL, None),
        (AT_GOAL, "magenta1", Outcome.SAVED, "magenta1"),
        (AT_GOAL, "magenta2", Outcome.BLOCKED, "magenta2"),
        (AT_GOAL, "out", Outcome.MISSED, None),
        (AT_GOAL, "cyan1", Outcome.RECEIVED, "cyan1"),
        (AT_GOAL, "cyan2", Outcome.KEPT, None),
        (AT_GOAL, "whistle", Outcome.UNDECIDED, None),
        (PAST_GOAL, "out", Outcome.MISSED, None),
        (PAST_GOAL, "magenta1", Outcome.MISSED, "magenta1"),
        (PAST_GOAL, "magenta2", Outcome.BLOCKED, "magenta2"),
    ],
)
def test_a_kick_is_what_its_way_and_the_next_touch_make_of_it(film, speed, how, outcome, by) -> None:
    kick(film, speed)
    ends(film, how)
    story = only(film)
    assert (story.robot, story.outcome, story.by) == ("cyan2", outcome, by)
    assert story.time == pytest.approx(0.1)


def test_a_shot_that_goes_in_off_the_keeper_is_a_goal_and_no_save(film) -> None:
    kick(film)
    film.shot(touches=["magenta1"])
    film.shot(touches=["magenta1"])
    film.goal(Side.CYAN, "magenta1")
    assert (only(film).outcome, only(film).by) == (Outcome.GOAL, "magenta1")
    assert film.figures().sides[Side.MAGENTA].saves == 0


@pytest.mark.parametrize(("off", "outcome"), [((), Outcome.BLOCKED), (("magenta1",), Outcome.SAVED)])
def test_while_the_goalkeeper_is_off_the_field_a_shot_is_saved_by_who_keeps_in_its_place(film, off, outcome) -> None:
    kick(film)
    film.shot(touches=["magenta2"], off=off)
    film.shot(touches=["cyan1"], off=off)
    assert (only(film).outcome, only(film).by) == (outcome, "magenta2")
    assert film.figures().sides[Side.MAGENTA].saves == len(off)


def test_a_save_is_decided_when_somebody_else_has_the_ball(film) -> None:
    kick(film)
    film.shot(touches=["magenta1"])
    film.shot(touches=["cyan1"])
    film.goal(Side.CYAN, "cyan1")
    assert only(film).outcome is Outcome.SAVED
    figures = film.figures()
    assert figures.sides[Side.MAGENTA].saves == 1
    assert [robot.saves for robot in figures.robots] == [0, 0, 1, 0]
    assert figures.sides[Side.CYAN].goals == 1 and figures.sides[Side.CYAN].kicks.goals == 0


def test_the_keeper_who_kicks_a_saved_ball_away_has_saved_it(film) -> None:
    kick(film)
    film.shot(touches=["magenta1"])
    kick(film, (-3.0, 3.0, 0.0), "magenta1")
    film.ball = (4.0, 3.0)
    film.shot(touches=["magenta2"])
    outcomes = [(story.robot, story.outcome) for story in film.figures().kicks]
    assert outcomes == [("cyan2", Outcome.SAVED), ("magenta1", Outcome.RECEIVED)]


def test_a_pass_that_is_kicked_on_at_once_is_received_and_a_kick_of_its_own(film) -> None:
    kick(film, ELSEWHERE)
    film.ball = (3.0, 3.0)
    kick(film, ELSEWHERE, "cyan1")
    outcomes = [(story.robot, story.outcome, story.by) for story in film.figures().kicks]
    assert outcomes[0] == ("cyan2", Outcome.RECEIVED, "cyan1")


def test_a_ball_that_a_teammate_has_before_it_rolled_a_metre_is_no_completed_pass(film) -> None:
    kick(film, ELSEWHERE)
    film.ball = (0.5, 0.6)
    film.shot(touches=["cyan1"])
    assert only(film).outcome is Outcome.LOST


def test_touches_of_the_tick_of_the_kick_count_by_their_order(film) -> None:
    film.shot(touches=["magenta2", "cyan2"], kicked="cyan2", speed=ELSEWHERE)  # the opponent touched before the kick
    film.rest()
    film.shot(touches=["cyan2", "magenta2"], kicked="cyan2", speed=(-8.0, 0.0, 0.0))  # and here it came back off it
    first, second = film.figures().kicks
    assert (first.outcome, second.outcome, second.by) == (Outcome.KEPT, Outcome.BLOCKED, "magenta2")


def test_a_kick_while_the_game_is_stopped_is_none(film) -> None:
    film.shot(phase=Phase.STOPPED, running=False)
    kick(film)
    film.rest()
    assert film.figures().kicks == []


def test_a_shot_in_the_second_half_goes_the_other_way(film) -> None:
    film.shot(cyan_attacks=-1)
    film.rest(1)
    kick(film, (-8.0, 0.0, 0.0))
    ends(film, "out")
    assert only(film).outcome is Outcome.MISSED


def test_the_kick_of_a_restart_counts_from_start_on(film) -> None:
    film.shot(phase=Phase.KICK_OFF, running=True, side=Side.CYAN)
    film.rest(1)
    kick(film, ELSEWHERE)
    ends(film, "cyan1")
    assert only(film).outcome is Outcome.RECEIVED


def test_a_story_tells_mode_speed_and_place_of_the_kick(film) -> None:
    film.ball = (1.0, -2.0)
    kick(film, (6.0, 0.0, 2.5), mode=KickMode.LOB)
    story = only(film)
    assert (story.mode, story.x, story.y, story.speed) == (KickMode.LOB, 1.0, -2.0, pytest.approx(6.5))


def test_passes_and_shots_are_counted_by_robot_and_side(film) -> None:
    for robot, speed, how in (
        ("cyan2", ELSEWHERE, "cyan1"),
        ("cyan2", ELSEWHERE, "magenta2"),
        ("cyan1", AT_GOAL, "magenta1"),
        ("cyan1", AT_GOAL, "goal"),
        ("magenta2", (-8.0, 0.0, 0.0), "magenta1"),
    ):
        film.ball = (0.0, 0.0)
        film.shot(phase=Phase.PLAY, running=True)
        film.rest(1)
        kick(film, speed, robot)
        ends(film, how)
    figures = film.figures()
    cyan, magenta = (figures.sides[side].kicks for side in Side)
    assert (cyan.kicks, cyan.passes, cyan.passes_completed) == (4, 2, 1)
    assert (cyan.shots, cyan.shots_on_goal, cyan.goals) == (2, 2, 1)
    assert (magenta.passes, magenta.passes_completed, magenta.shots) == (1, 1, 0)
    assert [robot.kicks.passes for robot in figures.robots] == [0, 2, 0, 1]
    assert figures.sides[Side.MAGENTA].saves == 1
