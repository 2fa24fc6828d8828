"""Readings that cannot be true, and what becomes of those that can."""

import math

import pytest
from pytest import approx

from robot_agent.hardware.contract import BodyBall, Picture, SensorReadings
from robot_agent.hardware.dummy import Dummy
from robot_agent.hardware.own_percepts import OwnPercepts
from robot_agent.hardware.reading_checks import ReadingChecks
from schemas.config.sensors.compass import CompassReading
from schemas.config.sensors.range import RangeReading
from schemas.messages.radio import Motion
from schemas.messages.sight import Obstacle
from support.messages import make_setup

SETUP = make_setup()


@pytest.fixture
def checks():
    return ReadingChecks(SETUP.drive, jump=0.5, relocation=1.0)


def at(x, y=0.0, heading=0.0, **more):
    return Motion(x=x, y=y, heading=heading, **more)


def accepted(checks, time, motion=None, now=None, **more):
    return checks.accept(SensorReadings(time, motion, **more), time if now is None else now)


@pytest.mark.parametrize("wrong", [at(math.nan), at(0.0, math.inf), at(0.0, vx=math.nan)])
def test_a_pose_that_is_not_finite_is_refused_and_counted(checks, wrong):
    readings, faults = accepted(checks, 1.0, wrong)
    assert readings.motion is None and faults[0].startswith("motion: a reading is not finite")
    assert checks.health(1.0)["motion"].refused == 1


@pytest.mark.parametrize("wrong", [at(0.0, vx=9.0, vy=-9.0), at(0.0, omega=-25.0)])
def test_a_velocity_that_no_robot_of_the_profile_has_is_refused(checks, wrong):
    assert accepted(checks, 1.0, at(0.0, vx=6.0, omega=12.0))[0].motion is not None, "a robot that was hit"
    readings, faults = accepted(checks, 1.02, wrong)
    assert readings.motion is None and faults[0].startswith("motion: a robot does not drive at")


def test_a_pose_that_jumps_by_five_metres_is_refused_until_it_has_stayed_there(checks):
    assert accepted(checks, 0.0, at(0.0))[0].motion is not None
    refused = [accepted(checks, 0.02 * n, at(5.0 + 0.01 * n))[0].motion is None for n in range(1, 60)]
    assert refused == [True] * 50 + [False] * 9
    assert accepted(checks, 1.2, at(0.0))[1] == ["motion: the pose jumps by 5.50 m more than the robot can have driven"]


def test_poses_that_jump_about_are_never_believed(checks):
    accepted(checks, 0.0, at(0.0))
    assert all(accepted(checks, 0.02 * n, at(5.0 * (-1) ** n))[1] for n in range(1, 200))


@pytest.mark.parametrize(("time", "text"), [(1.5, "in the future"), (0.4, "older than the one before")])
def test_a_pose_of_another_time_is_refused(checks, time, text):
    accepted(checks, 0.5, at(0.0))
    assert text in accepted(checks, time, at(0.0), now=1.0)[1][0]


def test_pictures_and_sensors_that_are_not_finite_or_from_the_future_are_refused(checks):
    nan = Picture(1.0, BodyBall(math.nan, 0.0))
    late = Picture(2.0, None, (Obstacle(1.0, 0.0, 0.2),))
    scan = RangeReading(age=0.0, angle_min=0.0, angle_increment=0.1, distances=[1.0, math.nan, None])
    compass = CompassReading(age=0.0, heading=0.1)
    readings, faults = accepted(checks, 1.0, picture=nan, sensors={"front": scan, "north": compass})
    assert readings.picture is None and readings.sensors == {"north": compass}
    assert faults == ["camera: a picture has numbers that are not finite", "front: a reading is not finite"]
    ahead = {"north": CompassReading(age=-1.0, heading=0.1)}
    faults = accepted(checks, 1.0, picture=late, sensors=ahead)[1]
    assert faults == [f"{one} is 1.000 s in the future" for one in ("camera: a picture", "north: a reading")]
    assert accepted(checks, 50.0, picture=late)[1] == ["camera: a picture is 48 s old, at most 2"]


def test_the_rate_and_the_age_of_each_device_are_those_of_the_last_second(checks):
    for number in range(100):
        accepted(checks, 0.02 * number, at(0.0), picture=Picture(0.02 * number) if number % 2 else None)
    health = checks.health(2.0)  # the reading of 1.0 s is not in it
    assert (health["motion"].rate, health["camera"].rate, health["camera"].readings) == (49.0, 25.0, 50)
    assert health["motion"].age == approx(0.02)


def percepts_of(dummy, *times):
    seen = OwnPercepts()
    for time in times:
        seen.update(dummy.sense(time))
    return seen


@pytest.mark.parametrize("attack", [1, -1])
def test_a_picture_is_in_the_frame_of_the_team_wherever_the_robot_stands(attack):
    dummy = Dummy(SETUP.models["standard"], start=(2.0, -1.0, 0.7), ball=(4.0, 1.0), posts=((9.0, 9.0), (3.0, -1.0)))
    seen = percepts_of(dummy, 0.0).percept(0.1, attack)
    assert seen.own[:3] == approx([attack * 2.0, -attack * 1.0, 0.7 if attack > 0 else 0.7 - math.pi], abs=1e-4)
    assert seen.ball[:2] == approx([attack * 4.0, attack * 1.0], abs=1e-3)
    assert [(one.x, one.y) for one in seen.obstacles] == [
        approx((attack * x, attack * y), abs=1e-3) for x, y in ((3.0, -1.0), (9.0, 9.0))
    ], "the nearest first"
    assert (seen.visible, seen.ball_age, seen.obstacles_age) == (True, 0.1, 0.1)


def test_a_late_picture_is_placed_by_the_pose_at_which_it_was_taken():
    seen = OwnPercepts()
    for number in range(51):
        turned = at(0.02 * number, 0.0, 0.04 * number, vx=1.0, omega=2.0)
        seen.update(SensorReadings(0.02 * number, turned))
    pose = seen.pose_at(0.85)
    dx, dy = 3.0 - pose.x, 1.0 - pose.y
    c, s = math.cos(pose.heading), math.sin(pose.heading)
    seen.update(SensorReadings(1.0, None, Picture(0.85, BodyBall(c * dx + s * dy, c * dy - s * dx))))
    percept = seen.percept(1.0, 1)
    assert pose.x == approx(0.85) and pose.heading == approx(1.7)
    assert percept.ball[:2] == approx([3.0, 1.0], abs=1e-3) and percept.ball_age == approx(0.15)
    assert seen.ball_sight(percept).z is None


def test_a_ball_that_is_lost_stays_where_it_was_seen_with_its_age():
    seen = OwnPercepts()
    seen.update(SensorReadings(0.0, at(1.0), Picture(0.0, BodyBall(2.0, 0.0, z=0.11))))
    seen.update(SensorReadings(0.5, at(1.2), Picture(0.5)))
    percept = seen.percept(0.6, 1)
    assert (percept.ball[:3], percept.visible, percept.ball_age, percept.obstacles_age) == (
        [3, 0, 0.11],
        False,
        0.6,
        0.1,
    )


def test_readings_of_the_sensors_grow_older():
    seen = OwnPercepts()
    seen.update(SensorReadings(0.5, sensors={"north": CompassReading(age=0.1, heading=0.3)}))
    assert seen.readings(0.9)["north"].age == approx(0.5)
    assert seen.posed is None, "it does not know where it is"
