"""Momentum: half possession, half ground."""

import pytest
from pytest import approx

from recordings.soccer.stats.momentum import BINS, MIN_WIDTH_S, Momentum
from schemas.soccer.game import Phase


def test_a_side_that_has_the_ball_in_the_others_goal_has_it_all(script) -> None:
    script.ball = (11.0, 0.0)
    script.held_by = "cyan2"
    script.shot(touches=["cyan2"])
    script.rest(100)
    assert script.figures().momentum[1:] == approx([1.0, 1.0], abs=0.02)


def test_it_is_mirrored_with_the_sides(new_script) -> None:
    values = []
    for robot, sign, attack in (("cyan2", 1, 1), ("cyan2", -1, -1), ("magenta2", -1, 1)):
        script = new_script()
        script.ball = (sign * 4.0, 1.0)
        script.held_by = robot
        script.shot(touches=[robot], cyan_attacks=attack)
        script.rest(120)
        values.append(script.figures().momentum)
    assert values[1] == approx(values[0], abs=0.03)
    assert values[2] == approx([-value for value in values[0]], abs=0.03)


def test_a_free_ball_at_the_centre_and_a_stopped_game_give_no_side_momentum(script) -> None:
    script.rest(60)
    assert set(script.figures().momentum) == {0.0}
    script.held_by = "cyan2"
    script.shot(phase=Phase.STOPPED, running=False)
    script.rest(60)
    assert set(script.figures().momentum) == {0.0}


def test_a_long_match_has_no_more_values_than_a_page_shows() -> None:
    assert Momentum(0.0, 60.0, 11.0).width == MIN_WIDTH_S
    assert Momentum(0.0, 5400.0, 11.0).width == 5400.0 / BINS


@pytest.mark.parametrize(("ball", "momentum"), [((22.0, 0.0), 0.5), ((-22.0, 0.0), -0.5)])
def test_a_ball_beyond_the_goal_line_counts_as_one_on_the_line(script, ball, momentum) -> None:
    script.ball = ball
    script.rest(120)
    assert script.figures().momentum[1:] == approx([momentum] * len(script.figures().momentum[1:]))
    assert len(script.figures().momentum) > 1
