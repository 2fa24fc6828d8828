"""Brake before opponents: the speed toward an opponent, and what stays of the demand."""

import math

import pytest

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.skills.brake_before import BUMP, brake_before
from schemas.messages.command import Drive

LIMITS = DriveLimits(speed=4.0, turn_rate=8.0, acceleration=2.5, deceleration=5.0, turn_acceleration=40.0, tick=0.02)
RADIUS = 0.25


@pytest.mark.parametrize("heading", [0.0, 1.0, math.pi])
def test_toward_an_opponent_that_it_nearly_touches_a_robot_drives_slowly(heading):
    me = Body(0.0, 0.0, heading, BUMP * 1.0, 0.0)
    wanted = Drive(vx=4.0 * math.cos(heading), vy=-4.0 * math.sin(heading), omega=0.0)
    drive = brake_before(me, wanted, [(0.55, 0.0)], RADIUS, LIMITS)
    assert math.hypot(drive.vx, drive.vy) < 1.5


def test_far_away_or_beside_or_behind_the_demand_stays_the_same():
    me, wanted = Body(0.0, 0.0, 0.0, 4.0, 0.0), Drive(vx=4.0)
    for place in ((5.0, 0.0), (0.0, 0.6), (-0.6, 0.0)):
        assert brake_before(me, wanted, [place], RADIUS, LIMITS) is wanted


def test_the_speed_past_an_opponent_stays():
    drive = brake_before(Body(0.0, 0.0, 0.0, 0.0, 2.0), Drive(vx=3.0, vy=2.0), [(0.6, 0.0)], RADIUS, LIMITS)
    assert drive.vx < 1.5 and drive.vy == pytest.approx(2.0, abs=0.2)


def test_a_robot_that_brakes_in_time_arrives_below_a_charge():
    """Ticks of 20 ms with a drive that follows within its limits, one tick late."""
    x, speed, due = 0.0, 4.0, 4.0
    while x < 3.0 - 2 * RADIUS:
        wanted = brake_before(Body(x, 0.0, 0.0, speed, 0.0), Drive(vx=4.0), [(3.0, 0.0)], RADIUS, LIMITS)
        speed = max(speed - LIMITS.deceleration * LIMITS.tick, min(due, speed + LIMITS.acceleration * LIMITS.tick))
        x, due = x + speed * LIMITS.tick, wanted.vx
    assert 0.5 < speed < 1.5


@pytest.mark.parametrize("hard", [True, False])
def test_a_robot_too_fast_to_stop_brakes_with_its_whole_drive_before_it_drives_around(limits, plant, hard):
    """It has to stop within 1.2 m of air, and is to drive across the way to the opponent at full speed."""
    robot, opponent = plant(0.0, 0.0, 0.0, 3.0, 0.0), (1.2 + 2.0 * RADIUS, 0.0)
    fastest = 0.0
    for _ in range(60):
        me = robot.step(brake_before(robot.body, Drive(vy=4.0), [opponent], RADIUS, limits, hard=hard))
        if math.dist(me[:2], opponent) < 2.0 * RADIUS:
            fastest = max(fastest, me.vx)
    assert (fastest > 1.5) is not hard


def test_a_robot_that_brakes_hard_stops_across_the_way_as_demanded(limits):
    me = Body(0.0, 0.0, 0.0, 3.0, 2.0)
    for wanted, across in ((0.5, 0.5), (-1.0, 0.0), (3.0, 2.0)):
        drive = brake_before(me, Drive(vx=3.0, vy=wanted), [(0.8, 0.0)], RADIUS, limits, hard=True)
        assert drive.vy == pytest.approx(across)
        assert drive.vx < 1.5
