"""The drive: limits that really limit, in the body frame, whatever the heading."""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pytest import approx

from schemas.config.profile import load_profile
from schemas.config.ramp import Ramp, TurnRamp
from schemas.config.robot_model import RobotModel
from schemas.messages.command import Drive
from sim_host.actuation.drive_model import Bodies, DriveModel
from sim_host.actuation.traction_drive import TractionDrive
from sim_host.actuation.velocity_drive import VelocityDrive
from sim_host.snapshot import RobotState, RobotStates

MSL = load_profile("msl")
STEP, STEPS = MSL.time.physics_step, MSL.time.steps_per_tick
LIMITS, ROBOT = MSL.drive, RobotModel.standard(MSL)
SPEED = st.floats(-8, 8)
NOTHING_TOUCHED: Any = Bodies(None, (), ())  # type: ignore[arg-type]


MOVING, TURNING = Ramp(LIMITS, STEP, STEPS), TurnRamp(LIMITS, STEP, STEPS)


def run(now: complex, demand: complex, ticks: int, moving: Ramp = MOVING) -> list[complex]:
    """Velocities after each physics step of some ticks under one demand."""
    velocities, at = [], (now.real, now.imag)
    for _ in range(ticks):
        planned = moving.toward(at, moving.within_limits(demand.real, demand.imag))
        velocities += [complex(*velocity) for velocity in planned]
        at = planned[-1]
    return velocities


def test_from_rest_to_three_metres_a_second_takes_the_time_of_the_limit() -> None:
    """v / a = 3 / 2.5 = 1.2 s; simatch's limiter reached 2.97 m/s with the first command."""
    velocities = run(0, 3, 100)
    first = next(step for step, v in enumerate(velocities, 1) if v.real >= 3 - 1e-9)
    assert first * STEP == approx(3 / LIMITS.acceleration, abs=STEP)


def test_a_small_change_is_not_swallowed_and_a_stop_ends_at_rest() -> None:
    """In simatch changes below 0.035 m/s vanished, and the output never came to rest."""
    assert run(0, 0.01, 1)[-1] == approx(0.01)
    assert run(0.018, 0, 1)[-1] == approx(0.0, abs=1e-9)


def test_braking_uses_the_deceleration_limit() -> None:
    velocities = run(3, 0, 100)
    first = next(step for step, v in enumerate(velocities, 1) if abs(v) < 1e-9)
    assert first * STEP == approx(3 / LIMITS.deceleration, abs=STEP)


def test_turning_round_loses_speed_at_one_limit_and_gains_it_at_the_other() -> None:
    velocities = run(2, -2, 100)
    there = next(step for step, v in enumerate(velocities, 1) if v.real <= -2 + 1e-9)
    assert there * STEP == approx(2 / LIMITS.deceleration + 2 / LIMITS.acceleration, abs=2 * STEP)


def test_a_drive_that_gains_speed_faster_than_it_loses_it_keeps_both_limits() -> None:
    moving = Ramp(dataclasses.replace(LIMITS, acceleration=4.0, deceleration=2.0), STEP, STEPS)
    velocities = run(2, -2, 200, moving)
    rests = next(step for step, v in enumerate(velocities, 1) if v.real <= 0)
    there = next(step for step, v in enumerate(velocities, 1) if v.real <= -2 + 1e-9)
    assert max(v.real for v in velocities) < 2
    assert (rests * STEP, there * STEP) == (approx(2 / 2.0, abs=2 * STEP), approx(2 / 2.0 + 2 / 4.0, abs=2 * STEP))


@given(SPEED, SPEED)
def test_a_demand_beyond_top_speed_is_shortened_and_keeps_its_direction(vx: float, vy: float) -> None:
    demand = complex(vx, vy)
    end = run(0, demand, 300)[-1]
    assert abs(end) == approx(min(abs(demand), LIMITS.max_speed), abs=1e-6)
    if abs(demand) > 0.01:
        assert math.remainder(np.angle(end) - np.angle(demand), 2 * math.pi) == approx(0, abs=1e-6)


@given(SPEED, SPEED, SPEED, SPEED)
def test_no_step_changes_a_velocity_by_more_than_the_limits_allow(ax: float, ay: float, bx: float, by: float) -> None:
    now, demand = complex(ax, ay) / 2, complex(bx, by) / 2
    before = now
    for after in run(now, demand, 30):
        assert abs(after - before) <= LIMITS.deceleration * STEP + 1e-9
        if abs(after) > abs(before):
            assert abs(after) - abs(before) <= LIMITS.acceleration * STEP + 1e-9
        before = after


def test_top_speed_is_the_same_in_every_direction_of_the_body() -> None:
    """In simatch the top speed depends on the direction of travel in the field frame."""
    tops = [abs(run(0, 100 * complex(math.cos(a), math.sin(a)), 300)[-1]) for a in np.linspace(0, 2 * math.pi, 17)]
    assert tops == approx([LIMITS.max_speed] * 17)


@pytest.mark.parametrize(("now", "demand"), [(0.0, 3.0), (5.0, -5.0), (-2.0, 100.0)])
def test_the_turn_rate_keeps_its_own_limits(now: float, demand: float) -> None:
    before = now
    for _ in range(100):
        for after in TURNING.toward(before, TURNING.within_limits(demand)):
            assert abs(after - before) <= LIMITS.turn_acceleration * STEP + 1e-9
            before = after
    assert before == approx(max(-LIMITS.max_turn_rate, min(LIMITS.max_turn_rate, demand)))


@pytest.mark.parametrize("drive", [VelocityDrive, TractionDrive])
def test_robots_are_planned_each_for_itself(drive: type[DriveModel]) -> None:
    """In simatch all robots shared one memory."""
    states = [
        RobotState(0, 0, 0.4, angle, *twist, False) for angle, *twist in ((0, 0, 0, 0), (1, 1, 1, 2), (2, 0, -2, 0))
    ]
    demands = [Drive(vx=3.0), Drive(), Drive(vy=2.0, omega=1.0)]
    together = list(drive(MSL.time, [ROBOT] * 3).plan(RobotStates(states), demands, NOTHING_TOUCHED))
    for one, (state, demand) in enumerate(zip(states, demands, strict=True)):
        alone = drive(MSL.time, [ROBOT]).plan(RobotStates([state]), [demand], NOTHING_TOUCHED)
        assert [step[one] for step in together] == [step[0] for step in alone]


@pytest.mark.parametrize("drive", [VelocityDrive, TractionDrive])
@pytest.mark.parametrize(("acceleration", "deceleration"), [(2.0, 4.0), (4.0, 2.0)])
def test_a_robot_in_motion_brakes_at_the_deceleration(
    drive: type[DriveModel], acceleration: float, deceleration: float
) -> None:
    limits = dataclasses.replace(LIMITS, acceleration=acceleration, deceleration=deceleration)
    planned = drive(MSL.time, [dataclasses.replace(ROBOT, drive=limits)]).plan(
        RobotStates([RobotState(0, 0, 0.4, 0, 2, 0, 0, False)]), [Drive(vx=-2.0)], NOTHING_TOUCHED
    )
    assert list(planned)[-1][0][0] == approx(2 - deceleration * MSL.time.tick)


@pytest.mark.parametrize("step", [0.0025, 0.005, 0.01])
def test_an_acceleration_is_the_same_in_steps_of_any_length(step: float) -> None:
    """1 m/s is reached after v / a; the paper's code took every step for 7 ms."""
    moving = Ramp(LIMITS, step, 1)
    at, steps = (0.0, 0.0), 0
    while at[0] < 1 - 1e-9:
        at = moving.toward(at, (1.0, 0.0))[-1]
        steps += 1
    assert steps * step == approx(1 / LIMITS.acceleration, abs=step)
