"""The drive model `traction`: the velocity is set, and its change is limited as a vector in the field frame.

However a robot turns, no more than its grip acts on it: the change of its velocity, sideways or braking, is at most
`deceleration`, and its speed grows at most at `acceleration`. A robot that circles faster than that slides outward: its
velocity lags behind the demand, which turns with its body.
"""

from collections.abc import Sequence
from itertools import chain
from operator import attrgetter

import numpy as np

from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.messages.command import Drive
from sim_host.actuation.ramp import Flags, Floats, Ramp, Vectors
from sim_host.actuation.stuck_detector import MIN_SPEED, MIN_TURN_RATE, SLOW_SHARE
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotMotions, RobotStates

_twist = attrgetter("vx", "vy", "omega")
_UNDISTURBED = 1e-3
"""m/s and rad/s; a robot whose measured motion differs by no more from the set one was not disturbed."""
_STANDS = 1e-3
"""m/s; a slower robot moves in no direction yet, and gains speed in any."""
_TINY = 1e-12
"""m/s or s; avoids a division by zero for a velocity that does not change."""


class TractionDrive:
    """The drives of some robots, each with its own memory: the motion that was set last, in the field frame."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        drives = [model.drive for model in models]
        self._count = len(models)
        self._step = time.physics_step
        self._elapsed = time.physics_step * np.arange(1, time.steps_per_tick + 1)[:, None]
        self._moving = Ramp.of_moving(drives, time.physics_step, time.steps_per_tick)
        self._turning = Ramp.of_turning(drives, time.physics_step, time.steps_per_tick)
        self._gain = np.array([drive.acceleration for drive in drives])
        self._grip = np.array([max(drive.acceleration, drive.deceleration) for drive in drives])
        self._velocity: Vectors = np.full(self._count, np.inf, dtype=complex)
        self._turn_rate: Floats = np.full(self._count, np.inf)
        self._undisturbed: Flags = np.zeros(self._count, dtype=bool)
        self.held_back = self._undisturbed
        """Per robot, at the beginning of the tick: its motion is disturbed and well below its demand."""

    def reset(self) -> None:
        """Clear the memory: the next tick begins from the measured velocities."""
        self._velocity = np.full_like(self._velocity, np.inf)
        self._turn_rate = np.full_like(self._turn_rate, np.inf)

    def plan(self, robots: RobotStates, demands: Sequence[Drive]) -> list[list[FieldTwist]]:
        """The velocities of one tick, per physics step and robot; `demands` are in the body frames.

        The demanded direction is that of the heading halfway through the tick.
        """
        numbers = np.fromiter(chain.from_iterable(map(_twist, demands)), float, 3 * self._count).reshape(-1, 3)
        demand = self._moving.within_limits(numbers[:, 0] + 1j * numbers[:, 1])
        turn_demand = self._turning.within_limits(numbers[:, 2])
        velocity, turn_rate = self._now(robots.motions, np.abs(demand), np.abs(turn_demand))
        turn_rates = self._turning.toward(turn_rate, turn_demand)
        halfway = robots.motions.heading + turn_rates.sum(axis=0) * (self._step / 2)
        velocities = self._toward(velocity, demand * np.exp(1j * halfway))
        self._velocity, self._turn_rate = velocities[-1], turn_rates[-1]
        planned: list[list[FieldTwist]] = np.stack([velocities.real, velocities.imag, turn_rates], axis=-1).tolist()
        return planned

    def _toward(self, now: Vectors, demand: Vectors) -> Vectors:
        """Velocities after each step, shape (steps, n), on the way from the present to the demanded ones.

        The change along the motion and the change across it share the grip: half a circle for a robot that brakes, half
        an ellipse for one that gains speed.
        """
        change = demand - now
        along = np.where(np.abs(now) > _STANDS, now, change)
        parts = change * along.conj() / (np.abs(along) + _TINY)
        limit = np.where(parts.real > 0.0, self._gain, self._grip)
        duration = np.hypot(parts.real / limit, parts.imag / self._grip) + _TINY
        after: Vectors = now + change * np.minimum(self._elapsed / duration, 1.0)
        return after

    def _now(self, robots: RobotMotions, wanted: Floats, wanted_turn: Floats) -> tuple[Vectors, Floats]:
        """Velocities and turn rates as set, or as measured where a robot was disturbed; updates `held_back`."""
        pushed = np.abs(robots.velocity - self._velocity) > _UNDISTURBED
        turned = np.abs(robots.omega - self._turn_rate) > _UNDISTURBED
        if not (pushed | turned).any():
            self.held_back = self._undisturbed
            return self._velocity, self._turn_rate
        velocity: Vectors = np.where(pushed, robots.velocity, self._velocity)
        turn_rate: Floats = np.where(turned, robots.omega, self._turn_rate)
        slow = pushed & (np.abs(velocity) < SLOW_SHARE * wanted)
        slow_turn = turned & (np.abs(turn_rate) < SLOW_SHARE * wanted_turn)
        self.held_back = np.where(wanted > MIN_SPEED, slow, (wanted_turn > MIN_TURN_RATE) & slow_turn)
        return velocity, turn_rate
