"""The drive model `traction`: the velocity is set, and its change is limited as a vector in the field frame.

However a robot turns, no more than its grip acts on it: the change of its velocity, sideways or braking, is at most
`deceleration`, and its speed grows at most at `acceleration`. A robot that circles faster than that slides outward: its
velocity lags behind the demand, which turns with its body. A robot that may touch something yields to what is stronger
than its grip, in every physics step.

The cost of small arrays is numpy's overhead: all arrays are made once, and results are written into them.
"""

from collections.abc import Iterator, Sequence
from itertools import chain
from operator import attrgetter

import numpy as np

from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.messages.command import Drive
from sim_host.actuation.drive_model import Bodies, DriveModel, Plan
from sim_host.actuation.grip import Grip, accelerations
from sim_host.actuation.ramp import Flags, Floats, Vectors
from sim_host.actuation.stuck_detector import MIN_SPEED, MIN_TURN_RATE, SLOW_SHARE
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotMotions, RobotStates

_twist = attrgetter("vx", "vy", "omega")
_NUMBERS = 4
"""Numbers in a robot's motion: vx, vy, omega, and the imaginary part of the turn rate, which is 0."""
_UNDISTURBED = np.array(1e-3)
"""m/s and rad/s; a robot whose measured motion differs by no more from the set one was not disturbed."""
_BARELY = np.array(2.5e-4)
"""The share of a change that counts as motion: a robot slower than this share of it gains speed in any direction."""
_ONE = np.array(1.0)
_TINY = np.array(1e-30)
"""Avoids a division by zero for a velocity that does not change."""


class TractionDrive(DriveModel):
    """The drives of some robots, each with its own memory: the motion that was set last, in the field frame.

    Their motions are in one array: for each robot its velocity, x + iy, and then its turn rate.
    """

    yields = True

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        drives, steps = [model.drive for model in models], time.steps_per_tick
        count = self._count = len(models)
        self._half_step = np.array(time.physics_step / 2)
        self._elapsed = time.physics_step * np.arange(1, steps + 1)[:, None]
        self._top = np.array([top for drive in drives for top in (drive.max_speed, drive.max_turn_rate)])
        self._turn_reach = np.array([drive.turn_acceleration for drive in drives]) * self._elapsed
        self._turn_reach_back = -self._turn_reach
        self._per_gain = 1.0 / np.array([drive.acceleration for drive in drives])
        self._per_grip = 1.0 / np.array([accelerations(model)[0] for model in models])
        self._grip = Grip(models, time.physics_step)
        self._lead = np.array(self._grip.changes).ravel()
        self._demands, self._measured, self._last, self._slip, self._share = (
            np.zeros(2 * count, dtype=complex) for _ in range(5)
        )
        self._demand_numbers = self._demands.view(float).reshape(count, _NUMBERS)[:, :3]
        self._size = np.zeros(2 * count)
        self._angles, self._turned, self._target, self._change, self._along, self._parts = (
            np.zeros(count, dtype=complex) for _ in range(6)
        )
        self._speed, self._duration, self._halfway = (np.zeros(count) for _ in range(3))
        self._after = np.zeros((steps, 2 * count), dtype=complex)
        self._numbers = self._after.view(float).reshape(steps, count, _NUMBERS)[..., :3]
        self._gained = np.zeros((steps, count), dtype=complex)
        """Per step, the share of each change that is reached: real factors, of the kind of what they multiply."""
        self._turns = np.zeros((steps, count))
        self._remembers = False
        self._undisturbed: Flags = np.zeros(count, dtype=bool)
        self.held_back = self._undisturbed
        """Per robot, at the beginning of the tick: its motion is disturbed and well below its demand."""

    def reset(self) -> None:
        """Clear the memory: the next tick begins from the measured velocities."""
        self._remembers = False

    def plan(self, robots: RobotStates, demands: Sequence[Drive], bodies: Bodies) -> Plan:
        """The velocities of one tick, per physics step and robot; `demands` are in the body frames.

        The demanded direction is taken at the heading halfway through the tick.
        """
        twists = np.fromiter(chain.from_iterable(map(_twist, demands)), float, 3 * self._count)
        self._demand_numbers[...] = twists.reshape(-1, 3)
        demand, size = self._demands, self._size
        np.abs(demand, out=size)
        np.maximum(size, self._top, out=size)
        np.divide(self._top, size, out=self._share.real)
        demand *= self._share
        now, after = self._now(robots.motions), self._after
        turns = self._turns
        np.subtract(demand.real[1::2], now.real[1::2], out=self._halfway)
        np.minimum(self._halfway, self._turn_reach, out=turns)
        np.maximum(turns, self._turn_reach_back, out=turns)
        turns += now.real[1::2]
        after.real[:, 1::2] = turns
        np.add.reduce(turns, axis=0, out=self._halfway)
        self._halfway *= self._half_step
        np.add(self._halfway, robots.motions.heading, out=self._angles.imag)
        np.exp(self._angles, out=self._turned)
        np.multiply(demand[::2], self._turned, out=self._target)
        self._toward(now[::2], self._target, after[:, ::2])
        self._last[...] = after[-1]
        planned: list[list[FieldTwist]] = self._numbers.tolist()
        return self._yielding(planned, bodies) if bodies.touching else planned

    def _yielding(self, planned: list[list[FieldTwist]], bodies: Bodies) -> Iterator[list[FieldTwist]]:
        """The same plan, in which robots that may touch something change their motions by their grip at most."""
        engine = bodies.engine
        touching = [(robot, place) for robot, place in enumerate(bodies.indices) if place in bodies.touching]
        for number, twists in enumerate(planned, 1):
            for robot, place in touching:
                twist = self._grip.limited(robot, twists[robot], engine.robot_twist(place))
                twists[robot] = twist
                if number == len(planned):
                    self._last[2 * robot], self._last[2 * robot + 1] = complex(twist[0], twist[1]), twist[2]
            yield twists

    def _toward(self, now: Vectors, demand: Vectors, after: Vectors) -> None:
        """Write the velocities after each step, shape (steps, n), on the way from the present to the demanded ones.

        The change along the motion and the change across it share the grip: half a circle for a robot that brakes, half
        an ellipse for one that gains speed.
        """
        change, along, parts, speed, duration = self._change, self._along, self._parts, self._speed, self._duration
        np.subtract(demand, now, out=change)
        np.multiply(change, _BARELY, out=along)
        along += now
        np.abs(along, out=speed)
        np.conjugate(along, out=along)
        np.multiply(change, along, out=parts)
        ahead, aside = parts.real, parts.imag
        ahead *= np.where(ahead > 0.0, self._per_gain, self._per_grip)
        aside *= self._per_grip
        np.abs(parts, out=duration)
        duration += _TINY
        speed /= duration
        share = self._gained.real
        np.multiply(self._elapsed, speed, out=share)
        np.minimum(share, _ONE, out=share)
        np.multiply(change, self._gained, out=after)
        after += now

    def _now(self, robots: RobotMotions) -> Vectors:
        """The motions as set, or near the measured ones where a robot was disturbed; updates `held_back`.

        The plan of a disturbed robot leads its measured motion by as much as its grip changes in a step: one that is
        held back pushes with all its grip, and one that is let go has gained next to nothing.
        """
        measured, slip, size = self._measured, self._slip, self._size
        measured[::2], measured.real[1::2] = robots.velocity, robots.omega
        if not self._remembers:
            self._last[...] = measured
            self._remembers = True
        np.subtract(self._last, measured, out=slip)
        np.abs(slip, out=size)
        disturbed = size > _UNDISTURBED
        if True not in disturbed.tolist():
            self.held_back = self._undisturbed
            return self._last
        motions: Vectors = np.where(
            disturbed, measured + slip * (self._lead / np.maximum(size, self._lead)), self._last
        )
        wanted: Floats = np.abs(self._demands)
        slow = disturbed & (np.abs(measured) < SLOW_SHARE * wanted)
        moves, turns = wanted[::2] > MIN_SPEED, wanted[1::2] > MIN_TURN_RATE
        self.held_back = np.where(moves, slow[::2], turns & slow[1::2])
        return motions
