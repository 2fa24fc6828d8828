"""Detects stuck robots: those that make little progress against the progress that they demand.

A drive with a `stuck_window` compares both over this time (`sim_host.actuation.progress`). Without one, a robot is
stuck when it has been held back in each tick of 0.2 s, as in simatch; demands that flicker hide that.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from schemas.config.robot_model import RobotModel
from schemas.messages.command import Drive
from sim_host.actuation.progress import Progress
from sim_host.snapshot import RobotState

SLOW_SHARE = 0.5
"""A robot is held back below this share of its demanded speed, as in simatch."""
MIN_SPEED = 0.2
"""m/s; at a smaller demand, a stuck robot cannot be distinguished from a slow one."""
MIN_TURN_RATE = 0.8
"""rad/s; the same for a robot that only turns; corresponds to 0.2 m/s at its hull."""
_AFTER = 0.2
"""s; without a window, a robot that is held back for this long is stuck (in simatch: 40 checks at 5 ms)."""


class StuckDetector:
    """The progress or the timers of all robots, in the order of the roster."""

    def __init__(self, models: Sequence[RobotModel], tick: float) -> None:
        self._tick = tick
        self._drives = [model.drive for model in models]
        self._is_timed = np.array([drive.stuck_window == 0.0 for drive in self._drives], dtype=bool)
        self._any_timed = bool(self._is_timed.any())
        self._free = [False] * len(models)
        self.reset()

    def reset(self) -> None:
        """Reset all timers, and forget all progress."""
        self._held_for = np.zeros(len(self._drives))
        self._progress: dict[int, Progress] = {}
        self._all_free = True
        """No robot is held back: no timer runs, and no progress is watched."""

    def update(
        self, indices: Sequence[int], held: NDArray[np.bool_], robots: Sequence[RobotState], demands: Sequence[Drive]
    ) -> None:
        """Update the robots with these indices: whether each is held back in this tick, its state and its demand."""
        is_held = held.tolist()
        if self._all_free and True not in is_held:
            return
        if self._any_timed:
            self._held_for[indices] = (self._held_for[indices] + self._tick) * (held & self._is_timed[indices])
        watched = self._progress
        for place, index in enumerate(indices):
            if is_held[place] or index in watched:
                self._watch(index, is_held[place], robots[place], demands[place])
        self._all_free = not watched and not (self._any_timed and self._held_for.any())

    def _watch(self, index: int, is_held: bool, robot: RobotState, demand: Drive) -> None:
        """Update the progress of one robot, from the tick in which it is held back until it moves freely again."""
        progress = self._progress.get(index)
        if progress is None:
            if self._drives[index].stuck_window == 0.0:
                return
            progress = self._progress[index] = Progress(self._drives[index], self._tick, robot)
        progress.update(robot, demand)
        if progress.settled and not is_held:
            del self._progress[index]

    def stuck(self) -> list[bool]:
        """Per robot: it is stuck."""
        if self._all_free:
            return self._free
        stuck: list[bool] = (self._held_for >= _AFTER).tolist() if self._any_timed else self._free.copy()
        for index, progress in self._progress.items():
            stuck[index] = progress.stuck
        return stuck
