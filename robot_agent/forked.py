"""A process of a team that is forked by a fork server, instead of started as a Python of its own.

It runs a robot, or builds a team's brains before the launch.

The function that runs in it is imported by the supervisor, too: this module loads nothing heavy. `PRELOAD` is what the
fork server imports once for all robots. Nothing there starts threads or draws random numbers: a fork would have no such
threads, and the same numbers as its siblings.
"""

import fcntl
import gc
import multiprocessing
import os
import signal
import sys
from collections.abc import Mapping
from contextlib import suppress
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import TYPE_CHECKING

from robot_agent import run
from robot_agent.settings import AgentSettings
from schemas.config.settings_file import exit_status
from schemas.process.leash import OwnConfinement, confine

if TYPE_CHECKING:
    from robot_agent.build_check import BuildCheckSettings

PRELOAD = ("robot_agent.process", "robot_agent.build_check", "robot_agent.forked")
"""Modules that every robot needs, this one among them."""
SAFE_PATH = "PYTHONSAFEPATH"
"""Environment variable that keeps the current directory off the module path; set for the fork server alone."""


def run_forked(
    settings: AgentSettings, environment: Mapping[str, str], confinement: OwnConfinement, log: str, held: Connection
) -> None:
    """Run one robot as `python -m robot_agent` would; exits."""
    _begin(environment, confinement, log, held, settings.robot)
    sys.exit(exit_status(lambda: run(settings)))


def build_forked(
    settings: "BuildCheckSettings",
    environment: Mapping[str, str],
    confinement: OwnConfinement,
    log: str,
    held: Connection,
) -> None:
    """Build a team's brains as `python -m robot_agent.build_check` would; exits."""
    from robot_agent.build_check import build

    _begin(environment, confinement, log, held, "build_check")
    build(settings)


def _begin(environment: Mapping[str, str], confinement: OwnConfinement, log: str, held: Connection, name: str) -> None:
    """Give this process a group, log, environment and module path of its own, and this name.

    `environment` is the whole one. `held` is closed when the process leads its group: signals are sent to that group.
    """
    os.setpgid(0, 0)
    signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored by the fork server, if its launcher ignored it
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    held.close()
    _end_with_supervisor()
    _redirect(log)
    _close_inherited()
    gc.freeze()  # what the fork server has imported is shared memory, and stays so while it is not looked through
    os.environ.clear()
    os.environ.update(environment)
    confine(confinement)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    Path("/proc/self/comm").write_text(name)  # as `ps -o comm`, `top` and `pgrep` show it


def _end_with_supervisor() -> None:
    """Have the kernel kill this process's group when the supervisor ends, as a supervisor that is killed cannot.

    The parent's sentinel is a pipe whose other end the supervisor alone has; that end closes with the supervisor.
    """
    supervisor = multiprocessing.parent_process()
    assert supervisor is not None
    pipe = supervisor.sentinel
    fcntl.fcntl(pipe, fcntl.F_SETOWN, -os.getpgid(0))
    fcntl.fcntl(pipe, fcntl.F_SETSIG, signal.SIGKILL)
    fcntl.fcntl(pipe, fcntl.F_SETFL, fcntl.fcntl(pipe, fcntl.F_GETFL) | os.O_ASYNC)
    if wait([pipe], 0):  # it has closed before
        os._exit(1)


def _close_inherited() -> None:
    """Close all descriptors but standard streams and the supervisor's pipe.

    The supervisor's resource tracker is replaced by one that forgets: a robot cannot have it remove what is another's.
    """
    supervisor = multiprocessing.parent_process()
    assert supervisor is not None
    tracker = resource_tracker.getfd()
    assert tracker is not None
    forgets = os.open(os.devnull, os.O_WRONLY)
    os.dup2(forgets, tracker, inheritable=False)
    kept = {0, 1, 2, supervisor.sentinel, tracker}
    for handle in [int(entry.name) for entry in Path("/proc/self/fd").iterdir()]:
        if handle not in kept:
            with suppress(OSError):  # that of the listing itself
                os.close(handle)


def _redirect(log: str) -> None:
    """Write into a log, and read nothing."""
    nothing = os.open(os.devnull, os.O_RDONLY)
    written = os.open(log, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o666)
    for stream, handle in enumerate((nothing, written, written)):
        os.dup2(handle, stream)
    os.close(nothing)
    os.close(written)
