"""Detects stuck robots: each robot has a timer, which runs while the robot is held back."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

SLOW_SHARE = 0.5
"""A robot is held back below this share of its demanded speed, as in simatch."""
MIN_SPEED = 0.2
"""m/s; at a smaller demand, a stuck robot cannot be distinguished from a slow one."""
MIN_TURN_RATE = 0.8
"""rad/s; the same for a robot that only turns; corresponds to 0.2 m/s at its hull."""
_AFTER = 0.2
"""s; a robot that is held back for this long is stuck (in simatch: 40 checks at 5 ms)."""


class StuckDetector:
    """The timers of all robots, in the order of the roster."""

    def __init__(self, count: int, tick: float) -> None:
        self._tick = tick
        self._held_for = np.zeros(count)
        self._free = [False] * count
        self._all_free = True
        """No robot is held back: no timer runs."""

    def reset(self) -> None:
        """Reset all timers."""
        self._held_for = np.zeros_like(self._held_for)
        self._all_free = True

    def update(self, indices: Sequence[int], held: NDArray[np.bool_]) -> None:
        """Update the timers of the robots with these indices: whether each is held back in this tick."""
        if self._all_free and True not in held.tolist():
            return
        self._held_for[indices] = (self._held_for[indices] + self._tick) * held
        self._all_free = not np.logical_or.reduce(self._held_for)

    def stuck(self) -> list[bool]:
        """Per robot: it has been held back long enough to be stuck."""
        if self._all_free:
            return self._free
        stuck: list[bool] = (self._held_for >= _AFTER).tolist()
        return stuck
