"""Driving and turning against the closed forms of a trapezoid, on an ideal drive."""

import math

import pytest

from robot_agent.sdk.bodies import Body
from robot_agent.sdk.skills.braking import braking_speed, travel_time
from robot_agent.sdk.skills.go_to import TOLERANCE, drive, go_to
from robot_agent.sdk.skills.turn_to import turn_to
from schemas.frames import rotate, wrap
from schemas.wire.faults import FaultError


@pytest.mark.parametrize("distance", [0.01, 0.3, 2.0, 9.0])
def test_braking_from_the_braking_speed_takes_the_distance_including_the_lag(distance):
    speed = braking_speed(distance, 4.0, 0.1)
    assert speed * 0.1 + speed * speed / 8.0 == pytest.approx(distance)


def test_nothing_left_means_no_speed():
    assert braking_speed(0.0, 4.0, 0.1) == 0.0
    assert braking_speed(-1.0, 4.0, 0.1) == 0.0


@pytest.mark.parametrize(
    ("distance", "speed", "time"),
    [
        (2.0, 0.0, math.sqrt(2.0 * 2.0 / 2.5)),  # all of it accelerating
        (2.0, 4.0, 0.5),  # at top speed from the start
        (3.2 + 4.0, 0.0, 1.6 + 1.0),  # 1.6 s up to 4 m/s over 3.2 m, then 1 s
        (2.0, -5.0, 1.0 + 1.6 + (4.5 - 3.2) / 4.0),  # 1 s and 2.5 m of braking, then 4.5 m from rest
    ],
)
def test_travel_time_is_that_of_a_trapezoid(distance, speed, time):
    assert travel_time(distance, speed, 4.0, 2.5, 5.0) == pytest.approx(time)


@pytest.mark.parametrize("target", [(6.0, 0.0), (-3.0, 4.0), (0.4, -0.1), (0.0, 9.0)])
@pytest.mark.parametrize("heading", [0.0, 2.5])
def test_a_robot_stops_at_its_target_and_never_passes_it_by_more_than_two_centimetres(plant, limits, target, heading):
    robot = plant(0.0, 0.0, 0.0)
    length = math.hypot(*target)
    farthest, fastest = 0.0, 0.0
    for _ in range(400):
        me = robot.step(go_to(robot.body, *target, heading, limits))
        farthest = max(farthest, (me.x * target[0] + me.y * target[1]) / length)
        fastest = max(fastest, math.hypot(me.vx, me.vy))
    assert math.dist(me[:2], target) < TOLERANCE + 0.01
    assert math.hypot(me.vx, me.vy) < 1e-3
    assert farthest < length + 0.02
    assert fastest <= limits.speed + 1e-9
    assert wrap(me.heading - heading) == pytest.approx(0.0, abs=0.02)


def test_a_way_of_eight_metres_takes_little_longer_than_the_fastest_trapezoid(plant, limits):
    robot = plant(0.0, 0.0, 0.0)
    ticks = 0
    while math.dist(robot.body[:2], (8.0, 0.0)) > 0.1:
        robot.step(go_to(robot.body, 8.0, 0.0, 0.0, limits))
        ticks += 1
    top, up, down = limits.speed, limits.acceleration, limits.deceleration
    fastest = top / up + top / down + (8.0 - top * top / 2 / up - top * top / 2 / down) / top
    assert fastest < ticks * limits.tick < fastest + 0.5


@pytest.mark.parametrize("angle", [0.05, 1.0, -2.0, 3.1])
def test_a_turn_ends_at_its_heading_and_never_passes_it_by_more_than_a_degree(plant, limits, angle):
    robot = plant(0.0, 0.0, 0.0)
    beyond = 0.0
    for _ in range(200):
        me = robot.step(turn_to(robot.body, angle, limits))
        beyond = max(beyond, wrap(me.heading - angle) * math.copysign(1.0, angle) if abs(me.heading) > 0.01 else 0.0)
    assert me.heading == pytest.approx(angle, abs=0.01)
    assert beyond < math.radians(1.0)


def test_a_turn_goes_the_short_way_over_the_cut_at_pi(plant, limits):
    assert turn_to(Body(0.0, 0.0, 3.0), -3.0, limits).omega > 0.0


def test_a_demand_beyond_the_top_speed_keeps_its_direction(limits):
    me = Body(0.0, 0.0, 1.0)
    demand = drive(me, 30.0, 40.0, 0.0, limits)
    vx, vy = rotate(demand.vx, demand.vy, me.heading)
    assert (vx, vy) == pytest.approx((0.6 * limits.speed, 0.8 * limits.speed))


def test_a_turning_robots_demand_is_for_the_heading_it_will_have(limits):
    me = Body(0.0, 0.0, 0.0, omega=5.0)
    demand = drive(me, 1.0, 0.0, 0.0, limits)
    assert math.atan2(demand.vy, demand.vx) == pytest.approx(-5.0 * limits.tick)


@pytest.mark.parametrize(("vx", "vy"), [(math.nan, 0.0), (0.0, math.nan), (math.inf, 1.0)])
def test_a_demand_that_is_no_number_raises_where_it_is_made(limits, vx, vy):
    with pytest.raises(FaultError, match=r"drive\.v[xy] is (nan|inf)"):
        drive(Body(0.0, 0.0, 0.3), vx, vy, 0.0, limits)
