"""Which robots are stuck: each has its own clock, which runs while that robot is held back."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

SLOW_SHARE = 0.5
"""A robot is held back below this share of the speed it should have (simatch)."""
MIN_SPEED = 0.2
"""m/s; a smaller speed cannot tell a stuck robot from a careful one."""
MIN_TURN_RATE = 0.8
"""rad/s; the same for a robot that only turns: 0.2 m/s at its hull."""
_AFTER = 0.2
"""s of being held back that make a robot stuck (simatch: 40 checks at 5 ms)."""


class StuckDetector:
    """Times of all robots, in the order of the roster."""

    def __init__(self, count: int, tick: float) -> None:
        self._tick = tick
        self._held_for = np.zeros(count)
        self._free = [False] * count
        self._all_free = True
        """Nobody has been held back: there is nothing to count."""

    def reset(self) -> None:
        """Nobody has been held back."""
        self._held_for = np.zeros_like(self._held_for)
        self._all_free = True

    def update(self, indices: Sequence[int], held: NDArray[np.bool_]) -> None:
        """Whether the robots at these places are held back in this tick."""
        if self._all_free and True not in held.tolist():
            return
        self._held_for[indices] = (self._held_for[indices] + self._tick) * held
        self._all_free = not np.logical_or.reduce(self._held_for)

    def stuck(self) -> list[bool]:
        """Per robot: it has long been held back."""
        if self._all_free:
            return self._free
        stuck: list[bool] = (self._held_for >= _AFTER).tolist()
        return stuck
