"""The drive of each robot: a velocity demand in the body frame becomes velocities the body can really have.

One control tick is planned at once for all robots: within it the demand does not change. Speed and acceleration
limits hold in the body frame, where the wheels are, and a limit that bites keeps the direction of what it limits.
Planar vectors are complex numbers, x + iy: turning is multiplying.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from schemas.profile import Drive

Floats = NDArray[np.float64]
Vectors = NDArray[np.complex128]
Flags = NDArray[np.bool_]

FieldDrive = tuple[float, float, float]
"""vx, vy in m/s and omega in rad/s, field frame."""

_TINY = 1e-12
"""m/s; keeps directions of nothing finite."""


class DrivePlanner:
    """Plans the velocities of all robots over the physics steps of one tick."""

    def __init__(self, drives: Sequence[Drive], step: float, steps: int) -> None:
        elapsed = step * np.arange(1, steps + 1)[:, None]
        acceleration = np.array([drive.acceleration for drive in drives])
        deceleration = np.array([drive.deceleration for drive in drives])
        self._top_speed = np.array([drive.max_speed for drive in drives])
        self._top_turn_rate = np.array([drive.max_turn_rate for drive in drives])
        self._gain = acceleration * elapsed
        self._loss = deceleration * elapsed
        self._turn = np.array([drive.turn_acceleration for drive in drives]) * elapsed
        self._kept = 1.0 - acceleration / deceleration

    def within_limits(self, demand: Vectors) -> Vectors:
        """Demanded velocities, in m/s, shortened to top speed."""
        shortened: Vectors = demand * np.minimum(1.0, self._top_speed / (np.abs(demand) + _TINY))
        return shortened

    def turn_within_limits(self, demand: Floats) -> Floats:
        """Demanded turn rates, in rad/s, cut off at the top one."""
        cut: Floats = np.minimum(np.maximum(demand, -self._top_turn_rate), self._top_turn_rate)
        return cut

    def velocities(self, now: Vectors, demand: Vectors) -> Vectors:
        """Body velocities after each step, shape (steps, n), from those now toward the demanded ones; all in m/s.

        A demand beyond top speed is shortened. Speed against the direction of the change is lost at the deceleration
        limit, and only then speed is gained at the acceleration limit.
        """
        change = self.within_limits(demand) - now
        size = np.abs(change)
        direction = change / (size + _TINY)
        to_lose = np.maximum(-(now * direction.conj()).real, 0.0)
        done = np.minimum(self._loss, self._gain + self._kept * to_lose)
        after: Vectors = now + np.minimum(done, size) * direction
        return after

    def turn_rates(self, now: Floats, demand: Floats) -> Floats:
        """Turn rates after each step, shape (steps, n), from those now toward the demanded ones; all in rad/s."""
        change = self.turn_within_limits(demand) - now
        after: Floats = now + np.minimum(np.maximum(change, -self._turn), self._turn)
        return after
