"""Robots launched as forks of one process that has imported what all of them need, which is most of a launch.

Where the kernel is not Linux, and when the fork server is closed or gone, they are launched by their command lines.
"""

import ctypes
import json
import os
import socket
import sys
from pathlib import Path

from touchline.launch.child_process import ChildProcess, ProcessHandle
from touchline.launch.processes import Process, ProcessKind

_PR_SET_CHILD_SUBREAPER = 36
"""linux/prctl.h: who is left by its parent becomes a child of this process."""
_COMMAND = (sys.executable, "-m", "robot_agent")
"""How the command line of a robot begins that a fork server can raise."""
_TITLE_SPACE = "-" * 4000
"""As long a command line can be shown of a robot."""
_PATIENCE_S = 20.0
"""Wall time in which a robot has to be there; the first of them waits for the imports."""
_END_S = 2.0
"""Wall time in which a fork server that is not needed any more has to be gone."""


class ForkedProcess(ProcessHandle):
    """A robot from a fork server: a child of this process like any other."""

    def __init__(self, process: Process, log: Path, log_start: int, pid: int) -> None:
        super().__init__(process, log, log_start)
        self._pid = pid

    @property
    def pid(self) -> int:
        """Process id, which is also the id of its group."""
        return self._pid

    def _poll(self) -> int | None:
        try:
            pid, status = os.waitpid(self._pid, os.WNOHANG)
        except ChildProcessError:
            return 0  # whoever launched us has the kernel forget how children end; `subprocess` says the same of it
        return os.waitstatus_to_exitcode(status) if pid else None


class ForkServer:
    """Launches robots; the process they are forked from is launched with the first of them."""

    def __init__(self, log: Path) -> None:
        """`log`: for what that process says, which is nothing unless it cannot begin."""
        self._log = log
        self._server: ChildProcess | None = None
        self._socket: socket.socket | None = None
        self._open = sys.platform == "linux"

    def launch(self, process: Process, log: Path) -> ProcessHandle:
        """Launch a robot."""
        if self._open and process.command[:3] == _COMMAND:
            with log.open("ab") as out:
                log_start = out.tell()
            pid = self._fork(process, log)
            if pid is not None:
                return ForkedProcess(process, log, log_start, pid)
            self.close()
        return ChildProcess(process, log)

    def close(self) -> None:
        """Raise no more; the robots stay."""
        self._open = False
        if self._socket is not None:
            self._socket.close()
        if self._server is not None:
            self._server.end(_END_S)
            self._server = None
            if not self._log.stat().st_size:
                self._log.unlink()

    def _fork(self, process: Process, log: Path) -> int | None:
        """The robot's process id, or nothing where there is none."""
        connection = self._socket or self._start(process)
        wanted = {"arguments": process.command[3:], "environment": process.environment, "log": str(log)}
        try:
            connection.send(json.dumps(wanted).encode())
            return int(connection.recv(64) or 0) or None
        except OSError:
            return None  # it has ended, or takes too long

    def _start(self, first: Process) -> socket.socket:
        """Launch the process that robots are forked from, in the environment of the first of them."""
        ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1)
        self._socket, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self._socket.settimeout(_PATIENCE_S)
        command = (sys.executable, "-m", "robot_agent.fork_server", str(os.getpid()), _TITLE_SPACE)
        with theirs:
            self._server = ChildProcess(
                Process("fork_server", ProcessKind.AGENT, command, first.environment), self._log, theirs
            )
        return self._socket
