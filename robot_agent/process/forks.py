"""`python -m robot_agent.process.forks`: forks itself for each robot, so that ten robots import what they need once.

The launcher writes one request a line on standard input, and reads replies from standard output. A fork becomes what
`python -m MODULE ARGUMENTS` would be, with an environment, a log and limits of its own. Nothing is imported here that
starts threads or draws random numbers: a fork would have no such threads, and the same numbers as its siblings.
"""

import gc
import json
import os
import runpy
import selectors
import signal
import sys
from contextlib import suppress
from pathlib import Path
from typing import TypedDict

import robot_agent.process.run  # noqa: F401 - what every robot needs
from runtime.process.leash import OwnConfinement, confine, end_with


class ForkRequest(TypedDict):
    """What a fork becomes."""

    name: str
    """Its name in `ps -o comm`, `top` and `pgrep`."""
    module: str
    arguments: list[str]
    environment: dict[str, str]
    """Its whole environment."""
    confinement: OwnConfinement
    log: str
    """The file that its output is appended to."""


class ForkReply(TypedDict):
    """A process that has been forked, or has ended."""

    pid: int | None
    """None if none could be forked."""
    status: int | None
    """Exit status, negative for a signal; None when it has been forked."""


def serve() -> ForkRequest | None:
    """Fork for each request. Returns the request in the fork, and None in the server when the launcher is gone."""
    server = os.getpid()
    with selectors.DefaultSelector() as ready:
        ready.register(sys.stdin, selectors.EVENT_READ)
        while True:
            for key, _ in ready.select():
                if key.data is not None:
                    ready.unregister(key.fd)
                    os.close(key.fd)
                    _reply(key.data, os.waitstatus_to_exitcode(os.waitpid(key.data, 0)[1]))
                    continue
                line = sys.stdin.readline()
                if not line:
                    return None
                try:
                    pid = os.fork()
                except OSError:  # too many processes; those that run go on
                    _reply(None, None)
                    continue
                if pid == 0:
                    end_with(server)
                    request: ForkRequest = json.loads(line)
                    return request
                with suppress(ProcessLookupError):  # it has ended
                    os.setpgid(pid, pid)  # before the launcher sends a signal to the group
                ready.register(os.pidfd_open(pid), selectors.EVENT_READ, pid)
                _reply(pid, None)


def become(request: ForkRequest) -> None:
    """Run the requested module in this process, as a new interpreter would; exits.

    Raises:
        OSError: the kernel refuses the limits.
    """
    if not Path(request["log"]).parent.exists():
        sys.exit(1)  # the launcher was interrupted, and has removed what it prepared
    with Path(os.devnull).open("rb") as nothing, Path(request["log"]).open("ab") as log:
        for stream, file in enumerate((nothing, log, log)):
            os.dup2(file.fileno(), stream)
    os.closerange(3, os.sysconf("SC_OPEN_MAX"))  # handles of the robots that were forked before
    os.setpgid(0, 0)
    os.environ.clear()
    os.environ.update(request["environment"])
    Path("/proc/self/comm").write_text(request["name"])
    confine(request["confinement"])
    sys.argv[1:] = request["arguments"]
    runpy.run_module(request["module"], run_name="__main__", alter_sys=True)


def _reply(pid: int | None, status: int | None) -> None:
    sys.stdout.write(json.dumps(ForkReply(pid=pid, status=status)) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    gc.freeze()  # what has been imported is shared memory, and stays so while it is not looked through
    try:
        requested = serve()
        if requested is not None:
            become(requested)
    except KeyboardInterrupt:  # before the module has its own handler
        sys.exit(128 + signal.SIGINT)
