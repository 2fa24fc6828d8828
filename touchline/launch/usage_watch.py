"""Watches what robots use, with all that their programs have started, and finds what they leave behind.

Resource limits of Linux count for one process, or for all of a user; a robot's limits count for its processes together.
"""

import os
import signal
from collections.abc import Mapping
from contextlib import suppress
from typing import Protocol

from schemas.config.confinement import Limits
from touchline.launch.process_tree import Usage, children_of, process_line, proportional_memory, tree_of, usage_of

PERIOD_S = 0.5
"""Wall time between two looks: about a millisecond of CPU time for ten robots."""


class WatchedRobot(Protocol):
    """A robot's launched process, such as `touchline.launch.child_process.ProcessHandle`."""

    @property
    def pid(self) -> int:
        """Its process id."""

    def status(self) -> int | None:
        """Exit status; None while running."""

    def end_for(self, limit: str) -> None:
        """End it for exceeding this limit."""


def exceeded(usage: Usage, limits: Limits) -> str | None:
    """The limit that a robot exceeds; None for none."""
    used = {"processes": usage.threads, "memory": usage.memory / 1e9, "cpu_time": usage.cpu_s}
    return next((limit for limit, amount in used.items() if amount > getattr(limits, limit)), None)


class UsageWatch:
    """The robots of one match, their limits, and the processes that were seen to be theirs."""

    def __init__(self) -> None:
        self._processes_before = set(children_of(os.getpid()))
        self._own: set[int] = set()
        self._robot_of: dict[int, str] = {}

    def add_own(self) -> None:
        """Regard all present children of this process as its own: helpers that it has started itself."""
        self._own.update(pid for pid in children_of(os.getpid()) if pid not in self._robot_of)

    def check(self, robots: Mapping[str, tuple[WatchedRobot, Limits]]) -> None:
        """Look at all robots once; end those that exceed a limit."""
        for name, (robot, limits) in robots.items():
            if robot.status() is not None:
                continue
            tree = tree_of(robot.pid)
            self._robot_of.update(dict.fromkeys(tree, name))
            usage = usage_of(tree)
            limit = exceeded(usage, limits)
            if limit == "memory":  # perhaps only because forks share their pages
                limit = exceeded(usage._replace(memory=proportional_memory(tree)), limits)
            if limit is not None:
                robot.end_for(limit)

    def end_left_behind(self) -> dict[int, str]:
        """End processes that ended robots have left behind; returns their ids, and names of robots where known.

        Such processes have left the group of their robot, and are children of this process since their robot ended.
        """
        found: dict[int, str] = {}
        known = self._processes_before | self._own
        while left := [pid for pid in children_of(os.getpid()) if pid not in known]:
            for pid in left:
                line = process_line(pid)
                if line is not None and line.state != "Z":
                    found[pid] = self._robot_of.get(pid, "")
                for one in tree_of(pid):
                    with suppress(ProcessLookupError):
                        os.kill(one, signal.SIGKILL)
                with suppress(ChildProcessError):
                    os.waitpid(pid, 0)
        return found
