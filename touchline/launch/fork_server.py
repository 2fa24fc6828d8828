"""Launches robots, and builds brains before, with a fork server of the standard library that has the modules imported.

A robot is launched by its command line instead if the kernel is not Linux, if the robot has its own program, or if it
is restarted after a crash, or if it is isolated.
"""

import os
import signal
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from multiprocessing import Pipe, resource_tracker
from multiprocessing.connection import Connection
from pathlib import Path

from robot_agent.build_check import BuildCheckSettings
from robot_agent.forked import SAFE_PATH, build_forked, run_forked
from robot_agent.settings import AgentSettings
from schemas.process.leash import OwnConfinement
from touchline.launch.child_process import (
    ChildProcess,
    ProcessHandle,
    confinement_of,
    make_folder_of,
    write_settings_of,
)
from touchline.launch.process_table import Process
from touchline.launch.python_process import module_path_environment
from touchline.launch.robot_environment import server_environment
from touchline.launch.robot_fork import ROBOTS, RobotProcess

PATIENCE_S = 2.0
"""Wall time for a forked robot to lead its process group; normally a few milliseconds."""


class ForkedRobot(ProcessHandle):
    """A robot from the fork server: a child of that server, which reports its exit status."""

    def __init__(self, process: Process, log: Path, begin: int, robot: RobotProcess, group_ready: Connection) -> None:
        """`group_ready` closes as soon as the robot group_ready its process group."""
        super().__init__(process, log, begin)
        self._robot, self._group_ready = robot, group_ready

    @property
    def pid(self) -> int:
        """Process id, which is also the id of its group."""
        assert self._robot.pid is not None
        return self._robot.pid

    def _poll(self) -> int | None:
        return self._robot.exitcode

    def _signal_group(self, number: signal.Signals) -> None:
        self._group_ready.poll(PATIENCE_S)
        super()._signal_group(number)


class ForkServer:
    """Launches robots; the server starts with the first robot and ends with this process."""

    def __init__(self) -> None:
        self._can_fork = sys.platform == "linux"
        self._launched: set[str] = set()

    def launch(self, process: Process, log: Path) -> ProcessHandle:
        """Launch a Python robot with the fork server, any other process by its command line."""
        is_isolated = process.confinement is not None and process.confinement.is_isolated
        if isinstance(process.settings, AgentSettings) and process.name not in self._launched and not is_isolated:
            self._launched.add(process.name)
            robot = self._fork(process, process.settings, log)
            if robot is not None:
                return robot
        return ChildProcess(process, log)

    def prepare(self, environment: Mapping[str, str]) -> None:
        """Start the server, which imports what robots need while this process goes on."""
        if not self._can_fork:
            return
        safe = {**server_environment(environment), **module_path_environment(), SAFE_PATH: "1"}
        try:
            with _environment(safe):
                resource_tracker.ensure_running()  # when it starts, it unblocks the signal
                with _blocked(signal.SIGINT):
                    ROBOTS.ensure_running()
        except OSError:
            self._can_fork = False

    def _fork(self, process: Process, settings: AgentSettings, log: Path) -> ForkedRobot | None:
        """The robot; None without a fork server."""
        self.prepare(process.environment)
        if not self._can_fork:
            return None
        write_settings_of(process)
        make_folder_of(process)
        with log.open("ab") as out:
            begin = out.tell()
        started = self._start(run_forked, settings, *confinement_of(process), str(log))
        return ForkedRobot(process, log, begin, *started) if started is not None else None

    def fork_build(
        self, settings: BuildCheckSettings, environment: Mapping[str, str], confinement: OwnConfinement, log: Path
    ) -> tuple[RobotProcess, Connection] | None:
        """The process that builds a team's brains, and what closes when it leads its group; None without a server.

        `environment` is the whole one of the process; `prepare` has been called.
        """
        return self._start(build_forked, settings, environment, confinement, str(log)) if self._can_fork else None

    def _start(self, function: Callable[..., None], *arguments: object) -> tuple[RobotProcess, Connection] | None:
        group_ready, held = Pipe(duplex=False)
        process = RobotProcess(target=function, args=(*arguments, held))
        try:
            with held:
                process.start()
        except (OSError, EOFError):
            self._can_fork = False
            return None
        return process, group_ready


@contextmanager
def _blocked(number: signal.Signals) -> Iterator[None]:
    """Block a signal within the block: the fork server would end with a traceback while it starts."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {number})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _environment(whole: Mapping[str, str]) -> Iterator[None]:
    """Have this environment within the block: the fork server keeps the environment it is started with."""
    before = dict(os.environ)
    os.environ.clear()
    os.environ.update(whole)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)
