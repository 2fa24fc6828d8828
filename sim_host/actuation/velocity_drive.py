"""The drive `velocity`: the velocity that the limits allow is the velocity of the robot."""

from collections.abc import Sequence
from itertools import chain
from operator import attrgetter

import numpy as np

from schemas.command import Drive
from schemas.robot_model import RobotModel
from schemas.sections import TimeSteps
from sim_host.actuation.drive import FieldDrive, Flags, Ramp, Vectors
from sim_host.actuation.stuck import MOVING, SHARE, TURNING
from sim_host.snapshot import Motions, Robots

_twist = attrgetter("vx", "vy", "omega")
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
        self._told, self._measured = (np.zeros(2 * self._count, dtype=complex) for _ in range(2))
        self._told_numbers = self._told.view(float).reshape(self._count, _NUMBERS)[:, :3]
        steps = time.steps_per_tick
        self._angles = np.zeros((steps, self._count), dtype=complex)
        """i times the heading of each robot in each physics step."""
        self._turns = np.ones((steps, 2 * self._count), dtype=complex)
        """What turns each motion into the field frame: a turn rate is the same there."""
        self._set_in_body: Vectors = np.zeros(2 * self._count, dtype=complex)
        self._set_in_field: Vectors = np.zeros(2 * self._count, dtype=complex)
        self._undisturbed: Flags = np.zeros(self._count, dtype=bool)
        self.held = self._undisturbed
        """Per robot, as the tick begins: something keeps it well below its demand."""

    def forget(self) -> None:
        """Remember nothing: the robots' velocities are what is measured."""
        self._set_in_body = np.zeros_like(self._set_in_body)
        self._set_in_field = np.full_like(self._set_in_field, np.inf)

    def plan(self, robots: Robots, told: Sequence[Drive]) -> list[list[FieldDrive]]:
        """The drives of one tick: per physics step, per robot. What they are told is in their body frames."""
        twists = np.fromiter(chain.from_iterable(map(_twist, told)), float, 3 * self._count)
        self._told_numbers[...] = twists.reshape(-1, 3)
        after = self._ramp.toward(self._now(robots.motions), self._told)
        turn_rates = after[:, 1::2].real
        headings = np.add.accumulate(turn_rates, axis=0)
        headings -= turn_rates
        headings *= self._step
        np.add(headings, robots.motions.heading, out=self._angles.imag)
        np.exp(self._angles, out=self._turns[:, ::2])
        in_field = after * self._turns
        self._set_in_body, self._set_in_field = after[-1], in_field[-1]
        numbers = in_field.view(float).reshape(len(after), self._count, _NUMBERS)
        planned: list[list[FieldDrive]] = numbers[..., :3].tolist()
        return planned

    def _now(self, robots: Motions) -> Vectors:
        """Motions as they were set, or as measured where something stood in the way; notes who is held.

        A set velocity stays what it is in the turning body frame, as with wheels that keep their speeds.
        """
        measured = self._measured
        measured[::2], measured[1::2] = robots.velocity, robots.omega
        disturbed = np.abs(measured - self._set_in_field) > _AS_SET
        if True not in disturbed.tolist():
            self.held = self._undisturbed
            return self._set_in_body
        measured[::2] *= np.exp(-1j * robots.heading)
        motions: Vectors = np.where(disturbed, measured, self._set_in_body)
        wanted = np.minimum(np.abs(self._told), self._top)
        slow = disturbed & (np.abs(motions) < SHARE * wanted)
        moves, turns = wanted[::2] > MOVING, wanted[1::2] > TURNING
        self.held = np.where(moves, slow[::2], turns & slow[1::2])
        return motions
