"""One launched process: a session of its own, a log of its own, and an end at the latest with its supervisor."""

import os
import signal
import subprocess
import sys
from pathlib import Path

from arena import leash
from arena.processes import Process

_TAIL_BYTES = 8192


class Child:
    """A program that runs, or has run."""

    def __init__(self, process: Process, log: Path) -> None:
        self.process = process
        self.log = log
        command = [sys.executable, "-I", "-S", leash.__file__, str(os.getpid()), *process.command]
        with log.open("ab") as out:
            self._begin = out.tell()
            self._popen = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
                env={**os.environ, **process.environment},
                start_new_session=True,
            )

    @property
    def pid(self) -> int:
        """Process id, which is also the id of its group."""
        return self._popen.pid

    def status(self) -> int | None:
        """Exit status, negative for the signal that ended it; nothing while it runs."""
        known = self._popen.returncode
        status = self._popen.poll()
        if known is None and status is not None:
            self._signal_group(signal.SIGKILL)  # whatever it started goes with it
        return status

    def send(self, number: signal.Signals) -> None:
        """Send a signal to the program and all it started, unless it has ended."""
        if self._popen.returncode is None:
            self._signal_group(number)

    def last_lines(self, count: int = 5) -> list[str]:
        """The end of what it wrote to its log, without empty lines; what an earlier one wrote there is left out."""
        with self.log.open("rb") as log:
            log.seek(max(self._begin, self.log.stat().st_size - _TAIL_BYTES))
            text = log.read().decode("utf-8", "replace")
        return [line for line in text.splitlines() if line.strip()][-count:]

    def _signal_group(self, number: signal.Signals) -> None:
        try:
            os.killpg(self.pid, number)
        except ProcessLookupError:
            return  # nobody of it is left
