"""The drive model `velocity`: the robot moves with the planned velocity, within the limits of its drive."""

from collections.abc import Sequence
from itertools import chain
from operator import attrgetter

import numpy as np

from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.messages.command import Drive
from sim_host.actuation.drive_model import Bodies, DriveModel
from sim_host.actuation.ramp import Flags, Ramp, Vectors
from sim_host.actuation.stuck_detector import MIN_SPEED, MIN_TURN_RATE, SLOW_SHARE
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotMotions, RobotStates

_twist = attrgetter("vx", "vy", "omega")
_NUMBERS = 4
"""Numbers in a robot's motion: vx, vy, omega, and the imaginary part of the turn rate, which is 0."""
_UNDISTURBED = np.array(1e-3)
"""m/s and rad/s; a robot whose measured motion differs by no more from the set one was not disturbed."""


class VelocityDrive(DriveModel):
    """The drives of some robots, each with its own memory.

    Their motions are in one array: for each robot its velocity, x + iy, and then its turn rate.
    """

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        drives = [model.drive for model in models]
        self._count = len(models)
        self._step = np.array(time.physics_step)
        self._top = np.array([top for drive in drives for top in (drive.max_speed, drive.max_turn_rate)])
        self._ramp = Ramp.of_both(drives, time.physics_step, time.steps_per_tick)
        self._demands, self._measured = (np.zeros(2 * self._count, dtype=complex) for _ in range(2))
        self._demand_numbers = self._demands.view(float).reshape(self._count, _NUMBERS)[:, :3]
        steps = time.steps_per_tick
        self._angles = np.zeros((steps, self._count), dtype=complex)
        """i times the heading of each robot in each physics step."""
        self._turns = np.ones((steps, 2 * self._count), dtype=complex)
        """The factor that turns each motion into the field frame; 1 for a turn rate."""
        self._last_in_body: Vectors = np.zeros(2 * self._count, dtype=complex)
        self._last_in_field: Vectors = np.zeros(2 * self._count, dtype=complex)
        self._undisturbed: Flags = np.zeros(self._count, dtype=bool)
        self.held_back = self._undisturbed
        """Per robot, at the beginning of the tick: its motion is disturbed and well below its demand."""

    def reset(self) -> None:
        """Clear the memory: the next tick begins from the measured velocities."""
        self._last_in_body = np.zeros_like(self._last_in_body)
        self._last_in_field = np.full_like(self._last_in_field, np.inf)

    def plan(self, robots: RobotStates, demands: Sequence[Drive], _bodies: Bodies) -> list[list[FieldTwist]]:
        """The velocities of one tick, per physics step and robot; `demands` are in the body frames."""
        twists = np.fromiter(chain.from_iterable(map(_twist, demands)), float, 3 * self._count)
        self._demand_numbers[...] = twists.reshape(-1, 3)
        after = self._ramp.toward(self._now(robots.motions), self._demands)
        turn_rates = after[:, 1::2].real
        headings = np.add.accumulate(turn_rates, axis=0)
        headings -= turn_rates
        headings *= self._step
        np.add(headings, robots.motions.heading, out=self._angles.imag)
        np.exp(self._angles, out=self._turns[:, ::2])
        in_field = after * self._turns
        self._last_in_body, self._last_in_field = after[-1], in_field[-1]
        numbers = in_field.view(float).reshape(len(after), self._count, _NUMBERS)
        planned: list[list[FieldTwist]] = numbers[..., :3].tolist()
        return planned

    def _now(self, robots: RobotMotions) -> Vectors:
        """The motions as set, or as measured where a robot was disturbed; updates `held_back`.

        A set velocity is constant in the turning body frame, as with wheels that keep their speeds.
        """
        measured = self._measured
        measured[::2], measured[1::2] = robots.velocity, robots.omega
        disturbed = np.abs(measured - self._last_in_field) > _UNDISTURBED
        if True not in disturbed.tolist():
            self.held_back = self._undisturbed
            return self._last_in_body
        measured[::2] *= np.exp(-1j * robots.heading)
        motions: Vectors = np.where(disturbed, measured, self._last_in_body)
        wanted = np.minimum(np.abs(self._demands), self._top)
        slow = disturbed & (np.abs(motions) < SLOW_SHARE * wanted)
        moves, turns = wanted[::2] > MIN_SPEED, wanted[1::2] > MIN_TURN_RATE
        self.held_back = np.where(moves, slow[::2], turns & slow[1::2])
        return motions
