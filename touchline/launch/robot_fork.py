"""Forks robots from a fork server of their own, beside the one that `multiprocessing` has for the whole process.

A fork server keeps the environment and the modules with which it was started. Whatever else in this process uses
`multiprocessing` (the matches of a series, a team's own script) started that one with others.
"""

import io
import os
from multiprocessing import forkserver, reduction, spawn, util
from multiprocessing.context import ForkServerProcess, set_spawning_popen
from multiprocessing.popen_forkserver import Popen
from multiprocessing.process import BaseProcess

from robot_agent.forked import PRELOAD

ROBOTS = forkserver.ForkServer()
"""Started with the first robot; it ends with this process."""
ROBOTS.set_forkserver_preload(list(PRELOAD))


class _ForkedPopen(Popen):
    """As its base class, which knows no fork server but that of the whole process."""

    def __init__(self, process: BaseProcess) -> None:
        self._descriptors: list[int] = []
        super().__init__(process)

    def duplicate_for_child(self, fd: int) -> int:
        """The place of a descriptor among those that the robot inherits."""
        self._descriptors.append(fd)
        return len(self._descriptors) - 1

    def _launch(self, process_obj: BaseProcess) -> None:
        pickled = io.BytesIO()
        set_spawning_popen(self)
        try:
            reduction.dump(_preparation_of(process_obj), pickled)
            reduction.dump(process_obj, pickled)
        finally:
            set_spawning_popen(None)
        self.sentinel, writer = ROBOTS.connect_to_new_process(self._descriptors)
        supervisor = os.dup(writer)  # stays open for as long as this process lives: the robot ends when it closes
        self.finalizer = util.Finalize(self, _close, (supervisor, self.sentinel))
        with os.fdopen(writer, "wb") as out:
            out.write(pickled.getbuffer())
        self.pid = forkserver.read_signed(self.sentinel)


def _preparation_of(process: BaseProcess) -> dict[str, object]:
    """What the robot takes over from this process: all but its main module, which a robot has no use for."""
    found = spawn.get_preparation_data(process.name)
    return {name: value for name, value in found.items() if not name.startswith("init_main_")}


def _close(*descriptors: int) -> None:
    for descriptor in descriptors:
        os.close(descriptor)


class RobotProcess(ForkServerProcess):
    """A process that is forked from the robots' fork server."""

    @staticmethod
    def _Popen(process_obj: BaseProcess) -> Popen:  # noqa: N802 - the name in its base class
        return _ForkedPopen(process_obj)
