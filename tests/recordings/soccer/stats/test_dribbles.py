"""Dribbles: ways with the ball in hand."""

import pytest
from pytest import approx

from schemas.soccer.game import Phase


def carry(script, metres: float, robot: str = "cyan2") -> None:
    script.held_by = robot
    script.shot(touches=[robot])
    for _ in range(round(metres / 0.1)):
        x, y = script.places[robot]
        script.places[robot] = (x + 0.1, y)
        script.shot(touches=[robot])


def of(script, robot: str = "cyan2"):
    one = next(one for one in script.figures().robots if one.name == robot)
    return one.dribbles, one.dribbled, one.longest_dribble


def test_a_dribble_is_a_metre_with_the_ball_at_least(script) -> None:
    carry(script, 0.8)
    script.held_by = None
    script.rest(10)
    assert of(script) == (0, 0.0, 0.0)
    carry(script, 1.5)
    script.held_by = None
    script.rest(10)
    carry(script, 2.0)
    assert of(script) == (2, approx(3.5), approx(2.0))


def test_the_way_of_a_dribble_is_measured_along_both_axes(script) -> None:
    script.held_by = "cyan2"
    script.shot(touches=["cyan2"])
    for _ in range(10):
        x, y = script.places["cyan2"]
        script.places["cyan2"] = (x + 0.3, y + 0.4)
        script.shot(touches=["cyan2"])
    assert of(script) == (1, approx(5.0), approx(5.0))


@pytest.mark.parametrize(("gap", "count"), [(3, 1), (8, 2)])
def test_a_hold_that_flickers_is_one_dribble(script, gap: int, count: int) -> None:
    carry(script, 1.5)
    script.held_by = None
    script.rest(gap)
    carry(script, 1.5)
    assert of(script)[0] == count


def test_a_touch_of_another_a_kick_and_a_stop_end_a_dribble(script) -> None:
    ends = (
        {"touches": ["magenta2"]},
        {"touches": ["cyan2"], "kicked": "cyan2"},
        {"phase": Phase.STOPPED, "running": False},
    )
    for end in ends:
        script.shot(phase=Phase.PLAY, running=True)
        script.rest(1)
        carry(script, 1.2)
        script.held_by = None
        script.shot(**end)
    script.shot(phase=Phase.PLAY, running=True)
    carry(script, 0.6)
    assert of(script) == (3, approx(3.6), approx(1.2))


def test_the_way_of_a_robot_that_is_placed_with_the_ball_is_no_dribble(script) -> None:
    carry(script, 1.2)
    script.places["cyan2"] = (5.0, -4.0)
    script.shot(touches=["cyan2"], placed=["cyan2"])
    carry(script, 0.3)
    assert of(script) == (1, approx(1.5), approx(1.5))
