"""Where a goalkeeper stands."""

import math

import pytest

from robot_agent.sdk.bodies import Ball
from robot_agent.soccer.skills.keep_goal import DEEP, guard_place, keep_goal, shot_place

PLACES = [(-9.3, -4.5), (-9.3, 4.5), (-5.0, 0.0), (0.0, 3.0), (-10.8, 2.0), (-10.9, -6.0)]


def angle(origin, point):
    return math.atan2(point[1] - origin[1], point[0] - origin[0])


@pytest.mark.parametrize("ball", PLACES)
def test_a_keeper_leaves_the_same_angle_free_to_both_posts_or_covers_the_near_one(setup, ball):
    """It halved the angle to two points on its own line, so that the near post was open."""
    pitch, radius = setup.pitch, setup.robot.reach
    x, y = guard_place(Ball(*ball), pitch, radius)
    half = 0.5 * pitch.goal_width
    if abs(y) < half - radius - 1e-6:
        low, middle, high = sorted(
            (
                angle(ball, (x, y)) % math.tau,
                *(angle(ball, (-pitch.goal_line, post * half)) % math.tau for post in (-1, 1)),
            )
        )
        assert middle - low == pytest.approx(high - middle, abs=0.02)
    else:
        assert y == pytest.approx(math.copysign(half - radius, ball[1]))


@pytest.mark.parametrize("aim", [-1.19, 0.3, 1.19])
def test_a_keeper_meets_a_shot_without_driving_into_a_post(setup, aim):
    pitch, radius = setup.pitch, setup.robot.reach
    x, _ = guard_place(Ball(-5.0, 0.0), pitch, radius)
    y = shot_place(Ball(-5.0, 0.0, -6.0, aim), x, pitch, radius)
    assert y is not None
    assert abs(y) + radius <= 0.5 * pitch.goal_width + 1e-9
    assert abs(y - aim) < radius + setup.ball.radius


def test_a_keeper_stands_between_the_posts_on_the_ball_side(setup):
    pitch, radius = setup.pitch, setup.robot.radius
    for y in (-6.0, -1.0, 0.0, 1.0, 6.0):
        gx, gy = guard_place(Ball(-5.0, y), pitch, radius)
        assert gx - radius == pytest.approx(-pitch.goal_line - DEEP)
        assert abs(gy) <= pitch.goal_width / 2
        assert gy == pytest.approx(-guard_place(Ball(-5.0, -y), pitch, radius)[1])
        assert gy * y >= 0.0


def test_a_shot_just_beside_the_post_is_awaited_at_the_post(setup):
    pitch, radius = setup.pitch, setup.robot.radius
    line, post = -pitch.goal_line + 0.4, pitch.goal_width / 2
    for side in (1.0, -1.0):
        beside = side * (post + 2.0 * radius)
        assert shot_place(Ball(-5.0, beside - side * 0.01, -8.0), line, pitch, radius) == side * (post - radius)
        assert shot_place(Ball(-5.0, beside + side * 0.01, -8.0), line, pitch, radius) is None


def test_a_shot_is_awaited_where_it_crosses_the_keepers_line(setup):
    pitch, radius = setup.pitch, setup.robot.radius
    line = -pitch.goal_line + 0.4
    assert shot_place(Ball(-5.0, 1.0, -8.0, 0.0), line, pitch, radius) == pytest.approx(pitch.goal_width / 2 - radius)
    assert shot_place(Ball(-5.0, 0.5, -8.0, 0.0), line, pitch, radius) == pytest.approx(0.5)
    assert shot_place(Ball(-5.0, 0.0, -8.0, 8.0), line, pitch, radius) is None  # wide
    assert shot_place(Ball(-5.0, 0.0, 3.0, 0.0), line, pitch, radius) is None  # away
    assert shot_place(Ball(9.0, 0.0, -2.0, 0.0), line, pitch, radius) is None  # can wait


def test_a_keeper_runs_to_a_shot(plant, limits, setup):
    robot = plant(-10.6, 0.0, 0.0)
    for tick in range(40):
        ball = Ball(-4.0 - 8.0 * tick * limits.tick, 0.6, -8.0, 0.0)
        robot.step(keep_goal(robot.body, ball, setup.pitch, setup.robot.radius, limits))
    assert robot.body.y == pytest.approx(0.6, abs=setup.robot.radius)
