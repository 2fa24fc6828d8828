"""How a demand becomes motion a body can really have: limits on speed and acceleration, for all robots at once.

One control tick is planned at once: within it the demand does not change. The limits hold in the body frame, where the
wheels are, and a limit that bites keeps the direction of what it limits. Planar vectors are complex numbers, x + iy:
turning is multiplying. A turn rate is a vector of one dimension, and obeys the same rules.

Small arrays cost what numpy does around them: one type in each operation, and constants that are arrays already, spare
it the buffers and conversions that take longer than ten multiplications.
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
"""m/s or rad/s, one of each robot."""

_ONE = np.array(1.0)
_ZERO = np.array(0.0)
_TINY = np.array(1e-12)
"""m/s; keeps directions of nothing finite."""


class Ramp:
    """The limits of some motions, and how each goes toward its demand over the physics steps of one tick."""

    def __init__(
        self,
        kind: type[float] | type[complex],
        limits: tuple[Sequence[float], Sequence[float], Sequence[float]],
        step: float,
        steps: int,
    ) -> None:
        """Top speed, and how fast speed is gained and lost, of each motion, which are all of a kind; `step` in s."""
        top, gain, loss = limits
        elapsed = step * np.arange(1, steps + 1)[:, None]
        self._top = np.array(top)
        self._gain = np.array(gain) * elapsed
        self._loss = np.array(loss) * elapsed
        self._spent = np.array(gain) / np.array(loss) - 1.0
        self._share: NDArray[Any] = np.zeros(self._top.shape, kind)
        self._size: NDArray[Any] = np.zeros(self._top.shape, kind)
        self._gained: NDArray[Any] = np.zeros(self._gain.shape, kind)
        """Real numbers of the kind that they are multiplied with, written through their real parts."""
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
        """The limits of each drive's velocity, and then of its turn rate."""
        pairs = zip(_moving(drives), _turning(drives), strict=True)
        top, gain, loss = ([limit for both in zip(*pair, strict=True) for limit in both] for pair in pairs)
        return cls(complex, (top, gain, loss), step, steps)

    def within_limits(self, demand: MotionArray) -> MotionArray:
        """Demanded motions, shortened to top speed."""
        speed: Floats = np.abs(demand) + _TINY
        np.minimum(_ONE, self._top / speed, out=self._real_share)
        shortened: MotionArray = demand * self._share
        return shortened

    def toward(self, now: MotionArray, demand: MotionArray) -> MotionArray:
        """Motions after each step, shape (steps, n), from those now toward the demanded ones.

        A demand beyond top speed is shortened. Speed against the direction of the change is lost at the deceleration
        limit, and only then speed is gained at the acceleration limit.
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
