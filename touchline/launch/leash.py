"""Run a program that dies with the process that launched it: `python leash.py PID PROGRAM …`.

The program can be ended by SIGINT and SIGTERM, even if the launcher ignores them, as shells have it for their
background jobs: an ignored signal stays ignored in the programs that a process starts.

This file is run by its path and imports the standard library alone, so that it costs a few milliseconds. It avoids
running code between fork and exec in a supervisor that has threads. If the kernel is not Linux, the program runs
without this protection.
"""

import ctypes
import os
import signal
import sys

_PR_SET_PDEATHSIG = 1
"""linux/prctl.h; the setting survives exec."""


def main(arguments: list[str]) -> int:
    """Become the program; if that fails, print the reason in one line and return 127."""
    launcher, *command = arguments
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != int(launcher):
            return 1  # the launcher died before prctl took effect
    try:
        os.execvp(command[0], command)
    except OSError as error:
        sys.stderr.write(f"{command[0]}: {error.strerror}\n")
    return 127


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
