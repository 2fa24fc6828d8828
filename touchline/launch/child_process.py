"""One launched process: it has its own process group and log, and does not outlive its supervisor."""

import os
import signal
import subprocess
import sys
from abc import ABC, abstractmethod
from pathlib import Path

from coach_gateway.ports import inheritance_of
from schemas.config.settings_file import write_settings
from schemas.errors import TouchlineError
from schemas.process.process_log import message_of
from touchline.launch import leash
from touchline.launch.processes import Process

_TAIL_BYTES = 8192


class ProcessHandle(ABC):
    """A launched process, running or ended; it leads its own process group."""

    def __init__(self, process: Process, log: Path, log_start: int) -> None:
        """The process appends its output to `log`, which has `log_start` bytes before."""
        self.process = process
        self.log = log
        self._log_start = log_start
        self._status: int | None = None

    @property
    @abstractmethod
    def pid(self) -> int:
        """Process id, which is also the id of its group."""

    @abstractmethod
    def _poll(self) -> int | None:
        """Exit status, negative for a signal; None while running. Not called again after the end."""

    def status(self) -> int | None:
        """Exit status, negative for the signal that ended the process; None while running."""
        if self._status is None:
            self._status = self._poll()
            if self._status is not None:
                self._signal_group(signal.SIGKILL)  # ends its descendants, too
        return self._status

    def send(self, number: signal.Signals) -> None:
        """Send a signal to the process group, unless the process has ended."""
        if self._status is None:
            self._signal_group(number)

    def last_lines(self, count: int = 5) -> list[str]:
        """The last lines of this process's output, without empty lines and without output of an earlier process."""
        with self.log.open("rb") as log:
            size = self.log.stat().st_size
            start = self._log_start if self._log_start <= size else 0  # the log was cut meanwhile
            log.seek(max(start, size - _TAIL_BYTES))
            text = log.read().decode("utf-8", "replace")
        lines = [part for line in text.splitlines() for part in message_of(line).splitlines()]
        return [line for line in lines if line.strip()][-count:]

    def _signal_group(self, number: signal.Signals) -> None:
        try:
            os.killpg(self.pid, number)
        except ProcessLookupError:
            return  # no process of the group is left


def write_settings_of(process: Process) -> None:
    """Write the settings file of a process; a team's own program has none.

    Raises:
        TouchlineError: the file cannot be written.
    """
    if process.settings is None or process.settings_file is None:
        return
    try:
        write_settings(process.settings, process.settings_file)
    except OSError as error:
        raise TouchlineError(f"{error.filename}: {error.strerror}; {process.name} reads its settings there") from None


class ChildProcess(ProcessHandle):
    """A program launched by its command line."""

    def __init__(self, process: Process, log: Path) -> None:
        """Writes the settings, if any, before the launch."""
        write_settings_of(process)
        command = [sys.executable, "-I", "-S", leash.__file__, str(os.getpid()), *process.command]
        with log.open("ab") as out:
            super().__init__(process, log, out.tell())
            self._popen = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
                env={**os.environ, **process.environment, **inheritance_of(process.sockets)},
                pass_fds=[one.fileno() for one in process.sockets],
                process_group=0,
            )

    @property
    def pid(self) -> int:
        """Process id, which is also the id of its group."""
        return self._popen.pid

    def _poll(self) -> int | None:
        return self._popen.poll()
