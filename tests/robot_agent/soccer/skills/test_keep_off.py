import math

import pytest

from robot_agent.soccer.skills.keep_off import inside, keep_off


def test_a_place_that_is_far_enough_stays(setup):
    assert keep_off(1.0, 5.0, (0.0, 0.0), 3.0, setup.pitch, 0.25) == (1.0, 5.0)


def test_a_place_that_is_too_near_moves_straight_out(setup):
    assert keep_off(1.0, 1.0, (0.0, 0.0), 3.0, setup.pitch, 0.25) == pytest.approx((3 / math.sqrt(2),) * 2)


@pytest.mark.parametrize("spot", [(10.7, 6.7), (-10.7, -6.7), (3.0, 6.85), (-7.4, 3.5)])
@pytest.mark.parametrize("wanted", [(10.9, 6.9), (-10.5, -6.5), (3.0, 6.8), (-8.0, 4.0)])
def test_every_place_is_on_the_pitch_and_far_enough(setup, spot, wanted):
    x, y = keep_off(*wanted, spot, 3.4, setup.pitch, 0.25)
    assert math.dist((x, y), spot) >= 3.4 - 1e-9
    assert inside(x, y, setup.pitch, 0.25) == (x, y)


def test_the_ball_itself_is_left_toward_the_own_goal(setup):
    x, y = keep_off(0.0, 0.0, (0.0, 0.0), 3.0, setup.pitch, 0.25)
    assert (x, y) == pytest.approx((-3.0, 0.0), abs=1e-9)
