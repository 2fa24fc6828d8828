"""Wheels: geometry, motors and grip of many robots at once, against closed forms."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.config.rolling import GRAVITY
from sim_host.actuation.wheels import Floats, WheelSets

STEP = 0.005
FOUR, THREE = (RobotModel.standard(load_profile(name)) for name in ("omni", "omni3"))
BOTH = pytest.mark.parametrize("model", [FOUR, THREE], ids=["four wheels", "three wheels"])


def with_wheels(model: RobotModel, **numbers: Any) -> RobotModel:
    return replace(model, wheels=replace(model.wheels, **numbers))


def column(*numbers: float) -> Floats:
    """A twist, or the wheels, of one robot."""
    return np.array(numbers, dtype=float)[:, None]


def seen_from_the_rim(model: RobotModel) -> tuple[float, float, float]:
    """Force of a motor at rest in N, its loss of force in N·s/m, and the mass of a wheel in kg."""
    wheels = model.wheels
    stall = wheels.stall_torque * wheels.gear / wheels.radius
    mass = (wheels.inertia + wheels.rotor_inertia * wheels.gear**2) / wheels.radius**2
    return stall, stall / wheels.no_load_rim_speed, mass


def test_rims_move_as_the_platforms_coefficients_say() -> None:
    """As in simatch: 0.707 (±vx ± vy) + 0.203 omega on four wheels, 0.866 vx and 0.5 vy on three."""
    vx, vy, omega = 1.2, -0.7, 0.9
    c, turning = math.sqrt(0.5), 0.203 * omega
    four = WheelSets([FOUR], STEP).rolling(column(vx, vy, omega))[:, 0]
    assert four == approx(
        [c * (vy - vx) + turning, -c * (vx + vy) + turning, c * (vx - vy) + turning, c * (vx + vy) + turning]
    )
    three = WheelSets([THREE], STEP).rolling(column(vx, vy, omega))[:, 0]
    s = math.sqrt(0.75)
    assert three == approx([-s * vx + vy / 2 + turning, -vy + turning, s * vx + vy / 2 + turning, 0.0])


@BOTH
def test_a_wheel_limit_shortens_the_twist_and_keeps_its_direction(model: RobotModel) -> None:
    """All wheels are scaled together."""
    wheels = WheelSets([model] * 50, STEP)
    twists = np.random.default_rng(3).normal(size=(3, 50)) * np.array([[4], [4], [15]])
    limited = wheels.within_limit(twists)
    shares = limited / twists
    assert np.ptp(shares, axis=0) == approx(np.zeros(50), abs=1e-12)
    fastest = np.abs(wheels.rolling(limited)).max(axis=0)
    assert fastest == approx(np.minimum(np.abs(wheels.rolling(twists)).max(axis=0), model.wheels.max_speed))
    assert (shares < 0.9).any() and (shares[0] == 1.0).any()


@BOTH
def test_a_robot_at_rest_stays_where_it_is(model: RobotModel) -> None:
    after = WheelSets([model], STEP).step(np.zeros((3, 1)), np.zeros((4, 1)), np.zeros((4, 1)))
    assert not after.push.any() and not after.speeds.any() and not after.twist.any()


@BOTH
def test_wheels_that_spin_push_with_all_their_grip_and_no_more(model: RobotModel) -> None:
    """Traction × weight along the rim of each wheel that slips far; along x that makes mu·g/√2 and mu·g/√3."""
    wheels = WheelSets([model], STEP)
    far = 2.0 * np.sign(wheels.rolling(column(1, 0, 0)).round(9))
    push = wheels.step(np.zeros((3, 1)), far, far).push[:, 0]
    share = math.sqrt(1 / 2 if model.wheels.count == 4 else 1 / 3)
    assert push == approx((model.wheels.traction * model.body.mass * GRAVITY * share, 0, 0), abs=1e-9)


@BOTH
def test_below_the_grip_the_force_grows_with_the_slip(model: RobotModel) -> None:
    """Force = slip stiffness × slip × weight on the wheel, of the speeds that the step ends with, to 1e-3."""
    wheels = WheelSets([model], STEP)
    load = model.body.mass * GRAVITY / model.wheels.count
    after = wheels.step(
        column(1, 0.5, 0.3), wheels.rolling(column(1, 0.5, 0.3)), wheels.rolling(column(1.02, 0.5, 0.3))
    )
    slip = after.speeds - wheels.rolling(after.twist)
    assert np.abs(after.traction).max() < model.wheels.traction * load
    assert after.traction == approx(model.wheels.slip_stiffness * load * slip, rel=1e-3, abs=1e-6)


def test_rollers_roll_freely_across_the_rim() -> None:
    """A lone pair of wheels could not slow this: across each rim the ground moves at 1 m/s, and no force arises."""
    wheels = WheelSets([with_wheels(FOUR, angle=0.0)], STEP)
    along_x = wheels.step(column(1, 0, 0), wheels.rolling(column(1, 0, 0)), np.zeros((4, 1))).traction[:, 0]
    assert along_x[[0, 2]] == approx([0, 0], abs=1e-9)  # their rims run along y
    assert np.abs(along_x[[1, 3]]).min() > 50


@BOTH
def test_no_motor_gives_more_than_its_line(model: RobotModel) -> None:
    """Torque at the end of a step lies between ±stall − stall × speed / no-load speed, in whatever state it began."""
    count = 2000
    wheels, random = WheelSets([model] * count, STEP), np.random.default_rng(5)
    twists = random.normal(size=(3, count)) * np.array([[2], [2], [5]])
    speeds = wheels.rolling(twists + random.normal(size=(3, count)) / 4)
    after = wheels.step(twists, speeds, wheels.rolling(random.normal(size=(3, count)) * 4))
    stall, line, mass = seen_from_the_rim(model)
    motor = mass * (after.speeds - speeds) / STEP + after.traction
    assert (motor <= stall - line * after.speeds + 1e-6).all()
    assert (motor >= -stall - line * after.speeds - 1e-6).all()
    assert (motor > 0.99 * (stall - line * after.speeds)).any()


MODELS = st.builds(
    lambda count, traction, gain, stall, stiffness, gear: with_wheels(
        FOUR if count == 4 else THREE,
        traction=traction,
        gain=gain,
        stall_torque=stall,
        slip_stiffness=stiffness,
        gear=gear,
    ),
    st.sampled_from([3, 4]),
    st.floats(0, 3),
    st.floats(1e-4, 10),
    st.floats(1e-3, 100),
    st.floats(0.1, 200),
    st.floats(0.5, 200),
)
TWIST = st.tuples(st.floats(-6, 6), st.floats(-6, 6), st.floats(-20, 20))


@settings(max_examples=100)
@given(MODELS, TWIST, TWIST, st.lists(st.floats(-3, 3), min_size=4, max_size=4))
def test_no_wheels_of_any_robot_put_in_more_energy_than_their_motors_gave(
    model: RobotModel, twist: tuple[float, float, float], told: tuple[float, float, float], slip: list[float]
) -> None:
    """Over half a second: kinetic energy, wheels and all, grows by at most the motors' work, to 1 % and 10 mJ.

    The tolerance is for the forces of stiff wheels that have not quite found each other in the rounds of a step.
    """
    wheels, now = WheelSets([model], STEP), column(*twist)
    _, _, rim_mass = seen_from_the_rim(model)
    there = np.abs(wheels.rolling(column(0, 0, 1)))
    speeds = wheels.rolling(now) + column(*slip) * (there > 0)
    masses = column(model.body.mass, model.body.mass, model.body.inertia_zz)

    def energy(twist: Floats, speeds: Floats) -> float:
        return float((masses * twist**2).sum() + rim_mass * (speeds**2).sum()) / 2

    before, work = energy(now, speeds), 0.0
    for _ in range(100):
        after = wheels.step(now, speeds, wheels.rolling(column(*told)))
        motor = rim_mass * (after.speeds - speeds) / STEP + after.traction
        work += float((motor * after.speeds).sum()) * STEP
        now, speeds = after.twist, after.speeds
        assert energy(now, speeds) - before <= work + 0.01 * abs(work) + 0.01
    assert np.isfinite(now).all() and np.isfinite(speeds).all()


@BOTH
def test_mirrored_robots_are_pushed_mirrored(model: RobotModel) -> None:
    """Left for right: y, turning, and the wheels of the two sides change places."""
    count = 300
    wheels, random = WheelSets([model] * count, STEP), np.random.default_rng(7)
    twist, slip, told = (random.normal(size=(3, count)) * size for size in (2.0, 0.02, 2.0))
    mirror = np.array([[1], [-1], [-1]])
    one = wheels.step(twist, wheels.rolling(twist + slip), wheels.rolling(told))
    other = wheels.step(mirror * twist, wheels.rolling(mirror * (twist + slip)), wheels.rolling(mirror * told))
    assert other.push == approx(mirror * one.push, abs=1e-7)
    order = [3, 2, 1, 0] if model.wheels.count == 4 else [2, 1, 0, 3]
    assert other.speeds == approx(-one.speeds[order], abs=1e-9)


def test_robots_are_moved_each_for_itself_whatever_stands_beside_them() -> None:
    """A robot on three wheels among those on four gets the same bits as alone."""
    models = [FOUR, THREE, with_wheels(FOUR, traction=0.3), THREE]
    random = np.random.default_rng(11)
    twist, told = random.normal(size=(3, 4)), random.normal(size=(3, 4)) * 3
    together = WheelSets(models, STEP)
    speeds = together.rolling(twist + random.normal(size=(3, 4)) / 10)
    both = together.step(twist, speeds, together.rolling(told))
    for place, model in enumerate(models):
        one, at = WheelSets([model], STEP), [place]
        alone = one.step(twist[:, at], speeds[:, at], one.rolling(told[:, at]))
        for mine, ours in zip(alone, both, strict=True):
            assert (mine == ours[:, at]).all()
