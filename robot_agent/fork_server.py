"""Robots forked from one process: what every robot needs is imported once, and each of them is a fork of that.

    python -m robot_agent.fork_server PID ROOM

Its stdin is a socket (SOCK_SEQPACKET). A packet asks for a robot, as JSON: the `arguments` that `python -m robot_agent`
would be given, the `environment` laid over this one, and the `log` for what it writes. The robot answers with its
process id, or 0 where nobody keeps it.
The robot is a child of PID, which has to be a subreaper (prctl(2)), and dies with it; it is called in lists of
processes as if it had been launched by itself. ROOM makes room for that name: as long a word as a command line may get.

Nothing that starts threads or draws random numbers may be imported here: a fork would have no such threads, and the
same numbers as its siblings. A brain is imported by the robot itself.
"""

import ctypes
import gc
import json
import os
import signal
import socket
import sys
import time
from pathlib import Path
from typing import Any

from robot_agent import __main__ as agent

_PR_SET_PDEATHSIG = 1
"""linux/prctl.h"""
_REPARENTING_S = 5.0
"""Wall time within which a robot is its launcher's child; it takes microseconds."""
_PACKET = 65_536


def main() -> int:
    """Fork robots until nobody can ask any more; in a robot, its own exit status."""
    launcher = int(sys.argv[1])
    gc.collect()
    gc.freeze()
    with socket.socket(fileno=os.dup(0)) as connection:
        while packet := connection.recv(_PACKET):
            child = os.fork()
            if child == 0:
                return _fork_again(json.loads(packet), launcher, connection)
            os.waitpid(child, 0)
    return 0


def _fork_again(wanted: dict[str, Any], launcher: int, connection: socket.socket) -> int:
    """Fork once more and leave, so that the robot becomes the launcher's; in the robot, its exit status."""
    if os.fork() != 0:
        os._exit(0)
    os.setpgid(0, 0)  # before anybody knows of it: signals are sent to the group that it leads from now on
    reparented = _is_reparented(launcher)
    connection.send(b"%d" % (os.getpid() if reparented else 0))
    connection.close()
    return _run(wanted) if reparented else 1


def _run(wanted: dict[str, Any]) -> int:
    """Be the robot; its exit status."""
    arguments: list[str] = wanted["arguments"]
    _redirect(wanted["log"])
    os.environ.update(wanted["environment"])
    sys.argv = [str(Path(agent.__file__)), *arguments]
    _set_title([sys.executable, "-m", "robot_agent", *arguments])
    return agent.main(arguments)


def _redirect(log: str) -> None:
    """Read nothing, and write into a log."""
    for target, path, flags in ((0, os.devnull, os.O_RDONLY), (1, log, os.O_WRONLY | os.O_APPEND | os.O_CREAT)):
        opened = os.open(path, flags, 0o666)
        os.dup2(opened, target)
        os.close(opened)
    os.dup2(1, 2)


def _is_reparented(launcher: int) -> bool:
    """Wait until this process is the launcher's child, and die with it from then on; whether there is a launcher."""
    deadline = time.monotonic() + _REPARENTING_S
    while os.getppid() != launcher and time.monotonic() < deadline:
        time.sleep(0.001)
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    return os.getppid() == launcher


def _set_title(command: list[str]) -> None:
    """Show this command line in lists of processes, as much of it as there is room for."""
    fields = Path("/proc/self/stat").read_text().rpartition(")")[2].split()
    start, end = int(fields[45]), int(fields[46])  # arg_start and arg_end of proc(5)
    words = b"\0".join(word.encode() for word in command)[: end - start - 1]
    ctypes.memmove(start, words.ljust(end - start, b"\0"), end - start)


if __name__ == "__main__":
    sys.exit(main())
