"""The chassis of all robots: what they were told becomes field-frame velocities for each physics step of a tick."""

from collections.abc import Sequence

import numpy as np

from schemas.host import AppliedInput
from schemas.profile import TimeSteps
from schemas.robot_model import RobotModel
from sim_host.actuation.drive import DrivePlanner, Flags, Floats, Vectors
from sim_host.snapshot import RobotState

FieldDrive = tuple[float, float, float]
"""vx, vy in m/s and omega in rad/s, field frame."""

_AS_SET = 1e-3
"""m/s; a robot that moves this exactly as it was set to was touched by nobody."""
_STUCK_SHARE = 0.5
"""A robot is slow below this share of its demand (simatch)."""
_STUCK_AFTER = 0.2
"""s of slowness that make a robot stuck (simatch: 40 checks at 5 ms)."""
_MOVING = 0.2
"""m/s; a smaller demand cannot tell a stuck robot from a careful one."""


class Chassis:
    """Motion of all robots, in the order of the roster; each robot has its own memory."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        count = len(models)
        self._tick = time.tick
        self._step = time.physics_step
        self._top = np.array([model.drive.max_speed for model in models])
        self._planner = DrivePlanner([model.drive for model in models], time.physics_step, time.steps_per_tick)
        self._set_in_body: Vectors = np.zeros(count, dtype=complex)
        self._set_in_field: Vectors = np.zeros(count, dtype=complex)
        self._slow_for = np.zeros(count)

    def forget(self) -> None:
        """Remember nothing: the robots' velocities are what is measured."""
        self._set_in_body = np.zeros_like(self._set_in_body)
        self._set_in_field = np.full_like(self._set_in_field, np.inf)
        self._slow_for = np.zeros_like(self._slow_for)

    def stuck(self) -> list[bool]:
        """Per robot: it has long moved much slower than demanded."""
        stuck: list[bool] = (self._slow_for >= _STUCK_AFTER).tolist()
        return stuck

    def plan(self, robots: Sequence[RobotState], inputs: Sequence[AppliedInput]) -> list[list[FieldDrive]]:
        """The drives of one tick: per physics step, per robot."""
        state = np.array(robots)
        told = np.array([(one.drive.vx, one.drive.vy, one.drive.omega) for one in inputs])
        demand = told[:, 0] + 1j * told[:, 1]
        body, disturbed = self._body_velocities(state)
        velocities = self._planner.velocities(body, demand)
        turn_rates = self._planner.turn_rates(state[:, 6], told[:, 2])
        headings = state[:, 3] + self._step * (np.cumsum(turn_rates, axis=0) - turn_rates)
        in_field = velocities * np.exp(1j * headings)
        self._watch(body, demand, disturbed)
        self._set_in_body, self._set_in_field = velocities[-1], in_field[-1]
        rows = zip(in_field.real.tolist(), in_field.imag.tolist(), turn_rates.tolist(), strict=True)
        return [list(zip(vx, vy, omega, strict=True)) for vx, vy, omega in rows]

    def _body_velocities(self, state: Floats) -> tuple[Vectors, Flags]:
        """Velocities as they were set, or as measured for the robots that something stood in the way of.

        A set velocity stays what it is in the turning body frame, as with wheels that keep their speeds.
        """
        measured = state[:, 4] + 1j * state[:, 5]
        disturbed = np.abs(measured - self._set_in_field) > _AS_SET
        if not disturbed.any():
            return self._set_in_body, disturbed
        return np.where(disturbed, measured * np.exp(-1j * state[:, 3]), self._set_in_body), disturbed

    def _watch(self, body: Vectors, demand: Vectors, disturbed: Flags) -> None:
        """Count for how long each robot has been held back below its demand."""
        if not disturbed.any():
            self._slow_for *= 0.0
            return
        wanted = np.minimum(np.abs(demand), self._top)
        slow = disturbed & (wanted > _MOVING) & (np.abs(body) < _STUCK_SHARE * wanted)
        self._slow_for = np.where(slow, self._slow_for + self._tick, 0.0)
