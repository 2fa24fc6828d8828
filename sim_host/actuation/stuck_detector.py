"""Detects stuck robots: those that make little progress against the progress that they demand.

Both are compared over the drive's `stuck_window` (`sim_host.actuation.progress`), since demands that flicker from tick
to tick hide that a robot is held back.
"""

from collections.abc import Sequence

from schemas.config.robot_model import RobotModel
from schemas.messages.command import Drive
from sim_host.actuation.progress import HeldBackMotion
from sim_host.snapshot import RobotState

SLOW_SHARE = 0.5
"""A robot is held back below this share of its demanded speed, as in simatch."""
MIN_SPEED = 0.2
"""m/s; at a smaller demand, a stuck robot cannot be distinguished from a slow one."""
MIN_TURN_RATE = 0.8
"""rad/s; the same for a robot that only turns; corresponds to 0.2 m/s at its hull."""


class StuckDetector:
    """The progress of all robots, in the order of the roster."""

    def __init__(self, models: Sequence[RobotModel], tick: float) -> None:
        self._tick = tick
        self._drives = [model.drive for model in models]
        self._free = [False] * len(models)
        self.reset()

    def reset(self) -> None:
        """Forget all progress."""
        self._progress: dict[int, HeldBackMotion] = {}

    def update(
        self, indices: Sequence[int], held: Sequence[bool], robots: Sequence[RobotState], demands: Sequence[Drive]
    ) -> None:
        """Update the robots with these indices: whether each is held back in this tick, its state and its demand."""
        watched = self._progress
        if not watched and True not in held:
            return
        for place, index in enumerate(indices):
            if held[place] or index in watched:
                self._watch(index, held[place], robots[place], demands[place])

    def _watch(self, index: int, is_held: bool, robot: RobotState, demand: Drive) -> None:
        """Update the progress of one robot, from the tick in which it is held back until it moves freely again."""
        progress = self._progress.get(index)
        if progress is None:
            progress = self._progress[index] = HeldBackMotion(self._drives[index], self._tick, robot)
        progress.update(robot, demand)
        if progress.settled and not is_held:
            del self._progress[index]

    def stuck(self) -> list[bool]:
        """Per robot: it is stuck."""
        if not self._progress:
            return self._free
        stuck = self._free.copy()
        for index, progress in self._progress.items():
            stuck[index] = progress.stuck
        return stuck
