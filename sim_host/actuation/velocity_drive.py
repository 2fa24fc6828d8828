"""The drive `velocity`: the velocity that the limits allow is the velocity of the robot."""

from collections.abc import Sequence
from itertools import chain

import numpy as np

from schemas.command import Drive
from schemas.robot_model import RobotModel
from schemas.sections import TimeSteps
from sim_host.actuation.drive import FieldDrive, Flags, Floats, Ramp, Vectors
from sim_host.actuation.stuck import MOVING, SHARE, TURNING
from sim_host.snapshot import RobotState

_NUMBERS = 4
"""Of a robot's motion: vx, vy, omega, and the imaginary part of the turn rate, which is 0."""
_AS_SET = np.array(1e-3)
"""m/s and rad/s; a robot that moves this exactly as it was set to was touched by nobody."""


class VelocityDrive:
    """Some robots of this drive, each with its own memory.

    Their motions stand in one array: of each robot its velocity, x + iy, and then its turn rate.
    """

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        drives = [model.drive for model in models]
        self._count = len(models)
        self._step = np.array(time.physics_step)
        self._top = np.array([top for drive in drives for top in (drive.max_speed, drive.max_turn_rate)])
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
        demand, measured = _motions(told), _motions(robots)
        heading = np.array([one.heading for one in robots])
        after = self._ramp.toward(self._now(measured, heading, demand), demand)
        turn_rates = after[:, 1::2].real
        headings = np.add.accumulate(turn_rates, axis=0)
        headings -= turn_rates
        headings *= self._step
        headings += heading
        in_field = after.copy()
        turned = np.zeros(headings.shape, dtype=complex)
        turned.imag = headings
        in_field[:, ::2] *= np.exp(turned, out=turned)
        self._set_in_body, self._set_in_field = after[-1], in_field[-1]
        numbers = in_field.view(float).reshape(len(after), self._count, _NUMBERS)
        planned: list[list[FieldDrive]] = numbers[..., :3].tolist()
        return planned

    def _now(self, measured: Vectors, heading: Floats, demand: Vectors) -> Vectors:
        """Motions as they were set, or as measured where something stood in the way; notes who is held.

        A set velocity stays what it is in the turning body frame, as with wheels that keep their speeds.
        """
        disturbed = np.abs(measured - self._set_in_field) > _AS_SET
        if True not in disturbed.tolist():
            self.held = self._undisturbed
            return self._set_in_body
        measured[::2] *= np.exp(-1j * heading)
        motions: Vectors = np.where(disturbed, measured, self._set_in_body)
        wanted = np.minimum(np.abs(demand), self._top)
        slow = disturbed & (np.abs(motions) < SHARE * wanted)
        moves, turns = wanted[::2] > MOVING, wanted[1::2] > TURNING
        self.held = np.where(moves, slow[::2], turns & slow[1::2])
        return motions


def _motions(twists: Sequence[RobotState] | Sequence[Drive]) -> Vectors:
    """Their velocities and turn rates."""
    rows = [(one.vx, one.vy, one.omega, 0.0) for one in twists]
    return np.fromiter(chain.from_iterable(rows), float, _NUMBERS * len(rows)).view(complex)
