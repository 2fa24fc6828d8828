"""Confines a process and ends it with its launcher: `python leash.py PID CONFINEMENT PROGRAM …` becomes the program.

The program can be ended by SIGINT and SIGTERM, even if the launcher ignores them, as shells do for their
background jobs: an ignored signal stays ignored in the programs that a process starts.

This file is run by its path and imports the standard library alone, so that it costs a few milliseconds. It avoids
running code between fork and exec in a supervisor that has threads. If the kernel is not Linux, the program runs
without this protection.
"""

import ctypes
import json
import os
import resource
import signal
import sys
from typing import TypedDict

_PR_SET_PDEATHSIG = 1
"""linux/prctl.h; the setting survives exec."""


class OwnConfinement(TypedDict, total=False):
    """What a process applies to itself; what is absent stays as it is."""

    limits: dict[str, tuple[int, int]]
    """Name in the module `resource` → soft and hard limit."""
    folder: str
    """Its working folder."""


def leashed(wanted: OwnConfinement) -> tuple[str, ...]:
    """The beginning of a command line that runs the rest of it, confined, until this process ends."""
    return (sys.executable, "-I", "-S", __file__, str(os.getpid()), json.dumps(wanted))


def confine(wanted: OwnConfinement) -> None:
    """Confine this process.

    Raises:
        OSError: the kernel refuses.
    """
    for name, (soft, hard) in wanted.get("limits", {}).items():
        number = getattr(resource, name)
        most = resource.getrlimit(number)[1]
        if most != resource.RLIM_INFINITY:
            soft, hard = min(soft, most), min(hard, most)
        resource.setrlimit(number, (soft, hard))
    if "folder" in wanted:
        os.chdir(wanted["folder"])


def main(arguments: list[str]) -> int:
    """Become the program; if that fails, print the reason in one line and return 127."""
    launcher, confinement, *command = arguments
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)
    try:
        confine(json.loads(confinement))
    except OSError as error:
        sys.stderr.write(f"touchline: this process cannot be confined: {error}\n")
        return 127
    end_with(int(launcher))
    try:
        os.execvp(command[0], command)
    except OSError as error:
        sys.stderr.write(f"{command[0]}: {error.strerror}\n")
    return 127


def end_with(parent: int) -> None:
    """Have the kernel kill this process when its parent ends; the parent's id is given, as it may have ended."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:
            os._exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
