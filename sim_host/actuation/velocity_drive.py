"""The drive `velocity`: the velocity that the limits allow is the velocity of the robot."""

from collections.abc import Sequence

import numpy as np

from schemas.command import Drive
from schemas.robot_model import RobotModel
from schemas.sections import TimeSteps
from sim_host.actuation.drive import FieldDrive, Flags, Floats, Ramp, Vectors
from sim_host.actuation.stuck import MOVING, SHARE, TURNING
from sim_host.snapshot import RobotState

_AS_SET = 1e-3
"""m/s and rad/s; a robot that moves this exactly as it was set to was touched by nobody."""


class VelocityDrive:
    """Some robots of this drive, each with its own memory.

    Their motions stand in one array: the velocities of all, x + iy, and then the turn rates of all.
    """

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        drives = [model.drive for model in models]
        self._count = len(models)
        self._step = time.physics_step
        self._top = np.array([drive.max_speed for drive in drives] + [drive.max_turn_rate for drive in drives])
        self._ramp = Ramp.of_both(drives, time.physics_step, time.steps_per_tick)
        self._set_in_body: Vectors = np.zeros(2 * self._count, dtype=complex)
        self._set_in_field: Vectors = np.zeros(2 * self._count, dtype=complex)
        self._undisturbed: Flags = np.zeros(self._count, dtype=bool)
        self.held = self._undisturbed
        """Per robot, as the tick begins: something keeps it well below its demand."""

    def forget(self) -> None:
        """Remember nothing: the robots' velocities are what is measured."""
        self._set_in_body = np.zeros_like(self._set_in_body)
        self._set_in_field = np.full_like(self._set_in_field, np.inf)

    def plan(self, robots: Sequence[RobotState], told: Sequence[Drive]) -> list[list[FieldDrive]]:
        """The drives of one tick: per physics step, per robot. What they are told is in their body frames."""
        count = self._count
        demand = np.array([complex(one.vx, one.vy) for one in told] + [one.omega for one in told], dtype=complex)
        measured = np.array([complex(one.vx, one.vy) for one in robots] + [one.omega for one in robots], dtype=complex)
        heading = np.array([one.heading for one in robots])
        after = self._ramp.toward(self._motions(measured, heading, demand), demand)
        velocities, turn_rates = after[:, :count], after[:, count:].real
        headings = heading + self._step * (np.add.accumulate(turn_rates, axis=0) - turn_rates)
        in_field = velocities * np.exp(1j * headings)
        self._set_in_body = after[-1]
        self._set_in_field = np.concatenate((in_field[-1], turn_rates[-1]))
        rows = zip(in_field.real.tolist(), in_field.imag.tolist(), turn_rates.tolist(), strict=True)
        return [list(zip(vx, vy, omega, strict=True)) for vx, vy, omega in rows]

    def _motions(self, measured: Vectors, heading: Floats, demand: Vectors) -> Vectors:
        """Motions as they were set, or as measured where something stood in the way; notes who is held.

        A set velocity stays what it is in the turning body frame, as with wheels that keep their speeds.
        """
        count = self._count
        disturbed = np.abs(measured - self._set_in_field) > _AS_SET
        if True not in disturbed.tolist():
            self.held = self._undisturbed
            return self._set_in_body
        in_body = np.concatenate((measured[:count] * np.exp(-1j * heading), measured[count:]))
        motions: Vectors = np.where(disturbed, in_body, self._set_in_body)
        wanted = np.minimum(np.abs(demand), self._top)
        slow = disturbed & (np.abs(motions) < SHARE * wanted)
        moves, turns = wanted[:count] > MOVING, wanted[count:] > TURNING
        self.held = np.where(moves, slow[:count], turns & slow[count:])
        return motions
