"""Crowds at the ball, and robots that are stuck, in a match made by hand."""

from pytest import approx

from schemas.soccer.game import Phase
from support.match_script import CORNERS

NEAR = {"cyan1": (0.5, 0.0), "cyan2": (-0.9, 0.0), "magenta2": (0.0, 0.95)}


def gather(script, *robots: str) -> None:
    script.places = CORNERS | {name: NEAR[name] for name in robots}


def test_three_robots_of_both_sides_within_a_metre_are_a_crowd(script) -> None:
    gather(script, "cyan1", "cyan2", "magenta2")
    script.rest(5)
    gather(script, "cyan1", "cyan2")
    script.rest(2)
    gather(script, "cyan1", "cyan2", "magenta2")
    script.rest(8)
    figures = script.figures()
    assert (figures.crowded_s, figures.longest_crowd_s) == (approx(1.3), approx(0.8))


def test_two_robots_are_no_crowd_and_a_third_off_the_field_does_not_count(script) -> None:
    gather(script, "cyan1", "cyan2")
    script.rest(5)
    gather(script, "cyan1", "cyan2", "magenta2")
    for _ in range(5):
        script.shot(off=["magenta2"])
    assert (script.figures().crowded_s, script.figures().longest_crowd_s) == (0.0, 0.0)


def test_a_crowd_is_one_only_while_the_ball_is_in_play(script) -> None:
    gather(script, "cyan1", "cyan2", "magenta2")
    script.shot(phase=Phase.STOPPED, running=False)
    script.rest(5)
    assert script.figures().crowded_s == approx(0.1)  # the tick in which play was stopped


def test_the_longest_time_stuck_has_no_interruption(script) -> None:
    for stuck in [True] * 4 + [False] + [True] * 7 + [False]:
        script.shot(stuck=["cyan2"] if stuck else [])
    times = {robot.name: robot.longest_stuck_s for robot in script.figures().robots}
    assert times == {"cyan1": 0.0, "cyan2": approx(0.7), "magenta1": 0.0, "magenta2": 0.0}


def test_the_way_while_the_game_clock_runs_is_part_of_the_whole(script) -> None:
    for clock in (0.0, 0.1, 0.2, 0.2, 0.2):
        x, y = script.places["cyan2"]
        script.places["cyan2"] = (x + 0.1, y)
        script.shot(clock=clock)
    (robot,) = (robot for robot in script.figures().robots if robot.name == "cyan2")
    assert (robot.distance, robot.clock_distance) == (approx(0.5), approx(0.2))
