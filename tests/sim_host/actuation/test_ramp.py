"""The drive: limits that really limit, in the body frame, whatever the heading."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pytest import approx

from schemas.config.profile import load_profile
from sim_host.actuation.ramp import Ramp

MSL = load_profile("msl")
STEP, STEPS = MSL.time.physics_step, MSL.time.steps_per_tick
LIMITS = MSL.drive
SPEED = st.floats(-8, 8)


MOVING = Ramp.of_moving([LIMITS], STEP, STEPS)
TURNING = Ramp.of_turning([LIMITS], STEP, STEPS)


def run(now: complex, demand: complex, ticks: int) -> list[complex]:
    """Velocities after each physics step of some ticks under one demand."""
    velocities, at = [], np.array([now])
    for _ in range(ticks):
        planned = MOVING.toward(at, np.array([demand]))
        velocities.extend(planned[:, 0].tolist())
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
    at = np.array([now])
    for _ in range(100):
        rates = TURNING.toward(at, np.array([demand]))
        for after in rates[:, 0].tolist():
            assert abs(after - before) <= LIMITS.turn_acceleration * STEP + 1e-9
            before = after
        at = rates[-1]
    assert before == approx(max(-LIMITS.max_turn_rate, min(LIMITS.max_turn_rate, demand)))


def test_robots_are_planned_each_for_itself() -> None:
    """In simatch all robots shared one memory."""
    now, demand = np.array([0, 1 + 1j, -2j]), np.array([3, 0, 2j])
    together = Ramp.of_moving([LIMITS] * 3, STEP, STEPS).toward(now, demand)
    for one in range(3):
        alone = MOVING.toward(now[one : one + 1], demand[one : one + 1])
        assert together[:, one] == approx(alone[:, 0])


def test_what_was_planned_stays_what_it_is_when_the_next_tick_is_planned() -> None:
    shortened, first = MOVING.within_limits(np.array([100j])), MOVING.toward(np.array([0j]), np.array([3 + 0j]))
    kept = shortened.copy(), first.copy()
    MOVING.toward(first[-1], np.array([-3j]))
    assert (shortened == kept[0]).all() and (first == kept[1]).all()


@pytest.mark.parametrize("step", [0.0025, 0.005, 0.01])
def test_an_acceleration_is_the_same_in_steps_of_any_length(step: float) -> None:
    """1 m/s is reached after v / a; the paper's code took every step for 7 ms."""
    moving = Ramp.of_moving([LIMITS], step, 1)
    at, steps = np.array([0j]), 0
    while at[0].real < 1 - 1e-9:
        at = moving.toward(at, np.array([1 + 0j]))[-1]
        steps += 1
    assert steps * step == approx(1 / LIMITS.acceleration, abs=step)
