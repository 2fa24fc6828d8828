"""Limits on speed and acceleration, which turn demanded motions into possible ones, for all robots together.

A whole control tick is planned in one step, since the demand does not change within it. Limits apply in the body frame,
where the wheels are, and keep the direction of the vector that they limit. Planar vectors are complex numbers, x + iy,
which are turned by multiplication. A turn rate is a vector of one dimension with the same rules.

The cost of small arrays is numpy's overhead: operations on a single type, and constants that are arrays, avoid buffers
and conversions that take longer than ten multiplications.
"""

from collections.abc import Sequence
from typing import Any, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from schemas.config.sections import DriveLimits

Floats = NDArray[np.float64]
Vectors = NDArray[np.complex128]
Flags = NDArray[np.bool_]
MotionArray = TypeVar("MotionArray", bound=NDArray[Any])
"""m/s or rad/s, one for each robot."""

_ONE = np.array(1.0)
_ZERO = np.array(0.0)
_TINY = np.array(1e-12)
"""m/s; avoids a division by zero for motions without a direction."""


class Ramp:
    """The limits of some motions, and their ramps toward demands over the physics steps of one tick."""

    def __init__(
        self,
        kind: type[float] | type[complex],
        limits: tuple[Sequence[float], Sequence[float], Sequence[float]],
        step: float,
        steps: int,
    ) -> None:
        """`limits` are top speed, acceleration and deceleration of each motion; all motions are of one `kind`.

        `step` is the physics step in s.
        """
        top, gain, loss = limits
        elapsed = step * np.arange(1, steps + 1)[:, None]
        self._top = np.array(top)
        self._gain = np.array(gain) * elapsed
        self._loss = np.array(loss) * elapsed
        self._spent = np.array(gain) / np.array(loss) - 1.0
        self._share: NDArray[Any] = np.zeros(self._top.shape, kind)
        self._size: NDArray[Any] = np.zeros(self._top.shape, kind)
        self._gained: NDArray[Any] = np.zeros(self._gain.shape, kind)
        """Real factors in arrays of the kind of the motions that they multiply, written through their real parts."""
        self._real_share, self._real_size, self._real_gained = self._share.real, self._size.real, self._gained.real

    @classmethod
    def of_moving(cls, drives: Sequence[DriveLimits], step: float, steps: int) -> Self:
        """The limits of the drives' velocities."""
        return cls(complex, _moving(drives), step, steps)

    @classmethod
    def of_turning(cls, drives: Sequence[DriveLimits], step: float, steps: int) -> Self:
        """The limits of the drives' turn rates."""
        return cls(float, _turning(drives), step, steps)

    @classmethod
    def of_both(cls, drives: Sequence[DriveLimits], step: float, steps: int) -> Self:
        """The limits of each drive's velocity, followed by the limits of its turn rate."""
        pairs = zip(_moving(drives), _turning(drives), strict=True)
        top, gain, loss = ([limit for both in zip(*pair, strict=True) for limit in both] for pair in pairs)
        return cls(complex, (top, gain, loss), step, steps)

    def within_limits(self, demand: MotionArray) -> MotionArray:
        """Demanded motions, scaled down to top speed."""
        speed: Floats = np.abs(demand) + _TINY
        np.minimum(_ONE, self._top / speed, out=self._real_share)
        shortened: MotionArray = demand * self._share
        return shortened

    def toward(self, now: MotionArray, demand: MotionArray) -> MotionArray:
        """Motions after each step, shape (steps, n), from the present ones toward the demanded ones.

        A demand beyond top speed is scaled down. Speed against the direction of the change is first lost at the
        deceleration limit; then speed is gained at the acceleration limit.
        """
        change = self.within_limits(demand) - now
        size = np.abs(change)
        np.add(size, _TINY, out=self._real_size)
        direction = change / self._size
        against = np.minimum((now * direction.conj()).real, _ZERO)
        gained = np.minimum(self._loss, self._gain + self._spent * against)
        np.minimum(gained, size, out=self._real_gained)
        after: MotionArray = self._gained * direction
        after += now
        return after


def _moving(drives: Sequence[DriveLimits]) -> tuple[list[float], list[float], list[float]]:
    return (
        [drive.max_speed for drive in drives],
        [drive.acceleration for drive in drives],
        [drive.deceleration for drive in drives],
    )


def _turning(drives: Sequence[DriveLimits]) -> tuple[list[float], list[float], list[float]]:
    changes = [drive.turn_acceleration for drive in drives]
    return [drive.max_turn_rate for drive in drives], changes, changes
