"""Letting the ball go: soft, ahead, and only where there is room."""

import pytest

from robot_agent.bodies import Body
from robot_agent.skills.let_go import AHEAD, FASTER, let_go


def test_the_ball_gets_a_little_more_speed_than_the_robot_has_toward_it(setup):
    assert let_go(Body(0.0, 0.0, 0.0, 2.0, 0.5), (), setup).speed == pytest.approx(2.0 + FASTER)
    assert let_go(Body(0.0, 0.0, 0.0, -2.0, 0.0), (), setup).speed == pytest.approx(FASTER)


@pytest.mark.parametrize(("me", "opponents"), [(Body(0.0, 0.0, 0.0), [(1.5, 0.2)]), (Body(10.0, 5.0, 0.0), [])])
def test_not_into_an_opponent_and_not_off_the_pitch(setup, me, opponents):
    assert let_go(me, opponents, setup) is None


def test_an_opponent_beside_the_path_is_no_hindrance(setup):
    assert let_go(Body(0.0, 0.0, 0.0), [(0.5 * AHEAD, 1.0)], setup) is not None
