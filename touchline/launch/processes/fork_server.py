"""The process that robots are forked from, `robot_agent.process.forks`: started once, asked for each robot.

Ten robots, each in a Python of its own, would spend ten seconds of CPU time on the same imports.
"""

import json
import signal
import subprocess
import sys
from contextlib import suppress
from queue import SimpleQueue
from threading import Thread
from typing import IO, TYPE_CHECKING

from runtime.process.leash import leashed
from touchline.launch.confinement.robot_environment import server_environment
from touchline.launch.processes.python_process import PYTHON, module_path_environment
from touchline.launch.processes.robot_process import ROBOT_ENVIRONMENT

if TYPE_CHECKING:
    from robot_agent.process.forks import ForkReply, ForkRequest


class ForkServer:
    """Forks robots; the process starts when it is first needed, and ends with this one."""

    def __init__(self) -> None:
        self._server: subprocess.Popen[str] | None = None
        self._is_serving = False
        self._forked: SimpleQueue[int | None] = SimpleQueue()
        self._statuses: dict[int, int] = {}

    def prepare(self) -> None:
        """Start the process, which imports what robots need while this one goes on."""
        if self._is_serving:
            return
        if self._server is not None:
            self._server.wait()
            with suppress(BrokenPipeError):  # of a request that it did not read
                self._requests.close()
        self._forked = SimpleQueue()
        self._server = subprocess.Popen(
            [*leashed({}), *PYTHON, "-m", "robot_agent.process.forks"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**server_environment(ROBOT_ENVIRONMENT), **module_path_environment()},
            process_group=0,
            text=True,
        )
        self._is_serving = True
        Thread(target=self._follow, args=(self._server.stdout, self._forked), daemon=True).start()

    def fork(self, request: "ForkRequest") -> int | None:
        """The process id of a new fork; None if there can be none."""
        if sys.platform != "linux":
            return None
        self.prepare()
        try:
            self._requests.write(json.dumps(request) + "\n")
            self._requests.flush()
        except BrokenPipeError:
            return None
        return self._forked.get()

    def status(self, pid: int) -> int | None:
        """Exit status of a fork, negative for a signal; None while it runs."""
        return self._statuses.get(pid)

    @property
    def _requests(self) -> IO[str]:
        assert self._server is not None and self._server.stdin is not None
        return self._server.stdin

    def _follow(self, replies: IO[str], forked: "SimpleQueue[int | None]") -> None:
        """Read replies until the process ends; its forks end with it."""
        running = set[int]()
        with replies:
            for line in replies:
                reply: ForkReply = json.loads(line)
                pid, status = reply["pid"], reply["status"]
                if pid is None:
                    forked.put(None)
                elif status is None:
                    self._statuses.pop(pid, None)  # of an earlier process with this id
                    running.add(pid)
                    forked.put(pid)
                else:
                    running.discard(pid)
                    self._statuses[pid] = status
        self._statuses.update(dict.fromkeys(running, -signal.SIGKILL))
        self._is_serving = False  # the process may go on for a moment, and reads no request
        forked.put(None)


ROBOTS = ForkServer()
"""The server of this process, for all its matches and checks."""
