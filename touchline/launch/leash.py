"""Run a program that dies with the process that launched it: `python leash.py PID PROGRAM …`.

A file run by its path with the standard library alone, so that it costs a few milliseconds, and so that nothing has
to run between fork and exec in a supervisor that has threads. Where the kernel is not Linux the leash is slack:
the program is run as it is.
"""

import ctypes
import os
import signal
import sys

_PR_SET_PDEATHSIG = 1
"""linux/prctl.h; the setting stays over exec."""


def main(arguments: list[str]) -> int:
    """Become the program, or say in one line why that cannot be (127)."""
    launcher, *command = arguments
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != int(launcher):
            return 1  # the launcher died before the leash was on
    try:
        os.execvp(command[0], command)
    except OSError as error:
        sys.stderr.write(f"{command[0]}: {error.strerror}\n")
    return 127


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
