import math

import pytest

from robot_agent.sdk.bodies import Ball, Body, DriveLimits
from schemas.config.rolling import Rolling

GROUND = Rolling(0.5)


def test_a_rolling_ball_goes_v_t_minus_half_a_t_squared():
    ball = Ball(1.0, 2.0, 3.0, 0.0).after(2.0, GROUND)
    assert (ball.x, ball.y, ball.vx) == pytest.approx((1.0 + 3.0 * 2.0 - 0.25 * 4.0, 2.0, 2.0))


def test_a_ball_stops_after_v_squared_over_two_a_and_rolls_no_farther():
    ball = Ball(0.0, 0.0, 0.0, -2.0)
    for time in (4.0, 9.0):
        assert ball.after(time, GROUND) == pytest.approx((0.0, -4.0, 0.0, 0.0))


def test_a_body_goes_on_as_it_does():
    assert Body(0.0, 0.0, 0.0, 1.0, -1.0, math.pi).after(0.5) == pytest.approx((0.5, -0.5, math.pi / 2, 1, -1, math.pi))


def test_a_capped_drive_is_never_faster_than_the_real_one(limits):
    assert limits.capped(2.0, 1.0)[:2] == (2.0, 1.0)
    assert limits.capped(99.0, 99.0) == limits
    assert limits.capped() == limits
    assert isinstance(limits, DriveLimits)
