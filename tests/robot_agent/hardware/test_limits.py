"""The limits of a robot on hardware, against those of the drives of the host."""

import math

import numpy as np
import pytest
from pytest import approx

from robot_agent.hardware.limits import toward, within_limits
from schemas.config.profile import load_profile
from schemas.config.ramp import Ramp, TurnRamp
from schemas.config.robot_model import RobotModel
from schemas.messages.command import Drive
from sim_host.actuation.wheels import WheelSets

DEMANDS = [(0.3, 0.0, 0.0), (3.0, 3.0, 9.0), (-5.0, 1.0, -20.0), (0.1, 0.2, 40.0), (8.0, -6.0, 2.0)]


def model(profile):
    return RobotModel.standard(load_profile(profile))


@pytest.mark.parametrize("demand", DEMANDS)
@pytest.mark.parametrize("profile", ["msl", "omni", "omni3"])
def test_a_demand_is_shortened_as_the_drive_of_the_profile_shortens_it_in_a_match(profile, demand):
    one = model(profile)
    vx, vy, omega = demand
    planned = Ramp(one.drive, 0.005, 4).within_limits(vx, vy)
    twist = np.array([*planned, TurnRamp(one.drive, 0.005, 4).within_limits(omega)]).reshape(3, 1)
    if one.drive.model == "omni":
        twist = WheelSets([one], 0.005).within_limit(twist)
    limited = within_limits(Drive(vx=vx, vy=vy, omega=omega), one)
    assert (limited.vx, limited.vy, limited.omega) == approx(tuple(twist[:, 0]), abs=1e-9)


@pytest.mark.parametrize("demand", DEMANDS)
def test_two_wheels_keep_the_curvature_and_lose_what_goes_sideways(demand):
    one = model("differential")
    vx, vy, omega = demand
    limited = within_limits(Drive(vx=vx, vy=vy, omega=omega), one)
    assert limited.vy == 0.0
    assert limited.vx * omega == approx(limited.omega * vx)
    assert max(map(abs, one.wheels.rim_speeds(limited.vx, 0.0, limited.omega))) <= one.wheels.max_speed * (1 + 1e-9)


def test_a_demand_within_the_limits_is_the_same_object():
    demand = Drive(vx=0.5, vy=0.2, omega=0.1)
    assert within_limits(demand, model("omni")) is demand


@pytest.mark.parametrize("profile", ["omni", "omni3", "differential"])
def test_a_twist_is_that_of_its_rim_speeds(profile):
    wheels = model(profile).wheels
    vy = 0.4 if wheels.count > 2 else 0.0
    assert wheels.twist(wheels.rim_speeds(0.7, vy, -1.2)) == approx((0.7, vy, -1.2))


def test_of_two_wheels_the_first_is_the_left_one_which_runs_backward_to_drive_ahead():
    wheels = model("differential").wheels
    assert wheels.rim_speeds(1.0, 0.0, 0.0) == (-1.0, 1.0)
    assert wheels.rim_speeds(0.0, 5.0, 1.0) == (wheels.arm, wheels.arm)


def test_a_demand_loses_speed_by_the_deceleration_and_turns_by_its_own_limit():
    one = model("msl")
    now = Drive(vx=2.0, omega=3.0)
    after = toward(now, Drive(), one, 0.1)
    assert math.hypot(after.vx, after.vy) == approx(2.0 - 0.1 * one.drive.deceleration)
    assert after.omega == approx(3.0 - 0.1 * one.drive.turn_acceleration)
    assert toward(now, Drive(), one, 0.0) == now and toward(now, now, one, 0.0) == now


@pytest.mark.parametrize("profile", ["msl", "omni", "paper"])
@pytest.mark.parametrize(
    ("now", "demand"), [((2.0, 0.0), (-3.0, 0.0)), ((1.0, 0.0), (0.0, 0.9)), ((0.3, 1.0), (2.0, -1.0))]
)
def test_a_robot_that_is_told_to_reverse_brakes_as_hard_as_in_a_match(now, demand, profile):
    one = model(profile)
    (planned,) = Ramp(one.drive, 0.02, 1).toward(now, demand)
    after = toward(Drive(vx=now[0], vy=now[1]), Drive(vx=demand[0], vy=demand[1]), one, 0.02)
    assert (after.vx, after.vy) == approx(planned)
