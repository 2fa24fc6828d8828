import math

import pytest

from robot_agent.sdk.bodies import Body
from robot_agent.sdk.skills.avoid import Circle, circles, circles_near, free_direction, go_around, steer

ME = Body(0.0, 0.0, 0.0)


def test_a_free_way_is_taken_as_it_is():
    assert free_direction(ME, 0.3, 3.0, [Circle(-1.0, 0.0, 0.5), Circle(1.0, -1.5, 0.5)]) == 0.3


def test_an_obstacle_behind_the_target_is_not_in_the_way():
    assert free_direction(ME, 0.0, 1.0, [Circle(1.6, 0.0, 0.5)]) == 0.0


def test_the_way_bends_to_the_nearer_side_and_clears_the_circle():
    direction = free_direction(ME, 0.0, 3.0, [Circle(1.5, 0.2, 0.5)])
    assert direction < 0.0
    assert 1.5 * math.sin(-direction) + 0.2 * math.cos(direction) >= 0.5


@pytest.mark.parametrize(("speed", "side"), [(0.0, -1.0), (0.29, -1.0), (0.31, 1.0), (2.0, 1.0)])
def test_a_robot_in_motion_passes_on_the_side_to_which_it_moves_already(speed, side):
    me = Body(0.0, 0.0, 0.0, speed * math.cos(0.8), speed * math.sin(0.8))
    direction = free_direction(me, 0.0, 3.0, [Circle(1.5, 0.05, 0.5)])
    assert math.copysign(1.0, direction) == side


def test_two_obstacles_without_a_gap_are_passed_as_one():
    direction = free_direction(ME, 0.0, 3.0, [Circle(1.5, 0.3, 0.5), Circle(1.5, -0.4, 0.5)])
    for circle in ((1.5, 0.3), (1.5, -0.4)):
        assert abs(circle[0] * math.sin(direction) - circle[1] * math.cos(direction)) >= 0.5


@pytest.mark.parametrize("depth", [0.02, 0.3])
def test_a_robot_within_a_circle_may_not_go_deeper(depth):
    away = 0.5 - depth
    direction = free_direction(ME, 0.0, 3.0, [Circle(away, 0.0, 0.5)])
    assert math.cos(direction) <= 0.0


def test_a_robot_that_is_shut_in_still_goes_where_it_wants():
    around = [Circle(math.cos(angle), math.sin(angle), 0.9) for angle in (0.0, 1.5, 3.0, 4.5)]
    assert free_direction(ME, 0.7, 3.0, around) == 0.7


def test_steering_keeps_the_speed():
    velocity = steer(ME, 2.0, 0.0, 3.0, [Circle(1.0, 0.1, 0.5)])
    assert math.hypot(*velocity) == pytest.approx(2.0)
    assert velocity[1] < 0.0
    assert steer(ME, 0.0, 0.0, 3.0, [Circle(1.0, 0.1, 0.5)]) == (0.0, 0.0)


@pytest.mark.parametrize("offset", [-0.3, 0.0, 0.25])
def test_a_robot_goes_around_an_obstacle_and_arrives(plant, limits, offset):
    robot = plant(-2.0, 0.0, 0.0)
    nearest = math.inf
    for _ in range(300):
        me = robot.step(go_around(robot.body, 2.0, 0.0, 0.0, [Circle(0.0, offset, 0.6)], limits))
        nearest = min(nearest, math.dist(me[:2], (0.0, offset)))
    assert math.dist(me[:2], (2.0, 0.0)) < 0.05
    assert nearest > 0.5


def test_circles_that_are_too_far_away_to_matter_are_left_out_without_a_change_of_the_way():
    points = [(0.37 * i - 6.0, (1.7 * i) % 7.0 - 3.5) for i in range(33)]
    near = circles_near(ME, points, 0.6)
    assert 0 < len(near) < len(points)
    for wanted in (-3.0, -1.2, 0.0, 0.4, 2.9):
        assert free_direction(ME, wanted, 5.0, near) == free_direction(ME, wanted, 5.0, circles(points, 0.6))
