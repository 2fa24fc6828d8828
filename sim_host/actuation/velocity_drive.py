"""The drive `velocity`: the velocity that the limits allow is the velocity of the robot."""

from collections.abc import Sequence

import numpy as np

from schemas.profile import TimeSteps
from schemas.robot_model import RobotModel
from sim_host.actuation.drive import DrivePlanner, FieldDrive, Flags, Floats, Vectors
from sim_host.actuation.stuck import MOVING, SHARE, TURNING

_AS_SET = 1e-3
"""m/s and rad/s; a robot that moves this exactly as it was set to was touched by nobody."""


class VelocityDrive:
    """Some robots of this drive, each with its own memory."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        count = len(models)
        self._step = time.physics_step
        self._top = np.array([model.drive.max_speed for model in models])
        self._top_turn = np.array([model.drive.max_turn_rate for model in models])
        self._planner = DrivePlanner([model.drive for model in models], time.physics_step, time.steps_per_tick)
        self._set_in_body: Vectors = np.zeros(count, dtype=complex)
        self._set_in_field: Vectors = np.zeros(count, dtype=complex)
        self._set_turn = np.zeros(count)
        self.held: Flags = np.zeros(count, dtype=bool)
        """Per robot, as the tick begins: something keeps it well below its demand."""

    def forget(self) -> None:
        """Remember nothing: the robots' velocities are what is measured."""
        self._set_in_body = np.zeros_like(self._set_in_body)
        self._set_in_field = np.full_like(self._set_in_field, np.inf)
        self._set_turn = np.full_like(self._set_turn, np.inf)

    def plan(self, state: Floats, told: Floats) -> list[list[FieldDrive]]:
        """The drives of one tick: per physics step, per robot.

        `state` has a row of `RobotState` for each robot, `told` its vx, vy and omega in the body frame.
        """
        demand = told[:, 0] + 1j * told[:, 1]
        body, disturbed = self._body_velocities(state)
        self.held = self._held(body, demand, disturbed, state[:, 6], told[:, 2])
        velocities = self._planner.velocities(body, demand)
        turn_rates = self._planner.turn_rates(state[:, 6], told[:, 2])
        headings = state[:, 3] + self._step * (np.cumsum(turn_rates, axis=0) - turn_rates)
        in_field = velocities * np.exp(1j * headings)
        self._set_in_body, self._set_in_field, self._set_turn = velocities[-1], in_field[-1], turn_rates[-1]
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

    def _held(self, body: Vectors, demand: Vectors, disturbed: Flags, turn: Floats, demanded_turn: Floats) -> Flags:
        """Robots that were disturbed, and are well below their demand: in moving, or in turning if that is all."""
        turn_disturbed = np.abs(turn - self._set_turn) > _AS_SET
        if not (disturbed | turn_disturbed).any():
            return disturbed
        wanted = np.minimum(np.abs(demand), self._top)
        wanted_turn = np.minimum(np.abs(demanded_turn), self._top_turn)
        slow = disturbed & (np.abs(body) < SHARE * wanted)
        slow_turn = turn_disturbed & (wanted_turn > TURNING) & (np.abs(turn) < SHARE * wanted_turn)
        held: Flags = np.where(wanted > MOVING, slow, slow_turn)
        return held
