"""One launched process: it has its own process group and log, and does not outlive its supervisor."""

import json
import os
import signal
import subprocess
import sys
from abc import ABC, abstractmethod
from contextlib import suppress
from pathlib import Path

from coach_gateway.ports import inheritance_of
from schemas.config.settings_file import STANDARD_INPUT, write_settings
from schemas.errors import TouchlineError
from schemas.process import leash
from schemas.process.leash import OwnConfinement
from schemas.process.process_log import message_of
from touchline.launch.bubblewrap import run_as
from touchline.launch.process_table import Process

_TAIL_BYTES = 8192
_SIGNAL_IN_BUBBLEWRAP = 128
"""bwrap ends with this and the number of the signal that ended its program."""
_SIGNALS_OF_LIMITS = {-signal.SIGXCPU: "cpu_time", -signal.SIGXFSZ: "file_size"}
"""Exit status → the limit for which the kernel ended a process."""


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
                if self.process.confinement is not None:
                    self.process.confinement.remove_empty_folder()
        return self._status

    def send(self, number: signal.Signals) -> None:
        """Send a signal to the process group, unless the process has ended; in bubblewrap, to all within."""
        if self._status is not None:
            return
        if self.process.confinement is not None and self.process.confinement.visible is not None:
            self._signal_within(number)
        else:
            self._signal_group(number)

    def breach(self) -> str:
        """What the process did beyond its limits, with the remedy, if it has ended for that; empty if not."""
        limit = _SIGNALS_OF_LIMITS.get(self._status or 0)
        limits = self.process.confinement.limits if self.process.confinement is not None else None
        return limits.breach(limit) if limit is not None and limits is not None else ""

    def last_lines(self, count: int = 5) -> list[str]:
        """The last lines of this process's output, without empty lines and without output of an earlier process."""
        with self.log.open("rb") as log:
            size = self.log.stat().st_size
            start = self._log_start if self._log_start <= size else 0  # the log was cut meanwhile
            log.seek(max(start, size - _TAIL_BYTES))
            text = log.read().decode("utf-8", "replace")
        lines = [part for line in text.splitlines() for part in message_of(line).splitlines()]
        return [line for line in lines if line.strip()][-count:]

    def _signal_within(self, number: signal.Signals) -> None:
        """Signal the programs in bubblewrap; bwrap itself ends with them, or at once by SIGKILL."""
        programs = [pid for init in _children_of(self.pid) for pid in _children_of(init)]
        if number == signal.SIGKILL or not programs:
            self._signal_group(number)
        for pid in programs:
            with suppress(ProcessLookupError):
                os.kill(pid, number)

    def _signal_group(self, number: signal.Signals) -> None:
        try:
            os.killpg(self.pid, number)
        except ProcessLookupError:
            return  # no process of the group is left


def _children_of(pid: int) -> list[int]:
    try:
        return [int(word) for word in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:  # it has ended, or the kernel does not list them
        return []


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


def make_folder_of(process: Process) -> None:
    """Make the working folder of a confined process.

    Raises:
        TouchlineError: it cannot be made.
    """
    try:
        if process.confinement is not None:
            process.confinement.make_folder()
    except OSError as error:
        raise TouchlineError(f"{error.filename}: {error.strerror}; {process.name} works there") from None


def confinement_of(process: Process) -> tuple[dict[str, str], OwnConfinement]:
    """The whole environment of a process, and what it applies to itself."""
    if process.confinement is None:
        return {**os.environ, **process.environment}, {}
    return process.confinement.environment(process.environment), process.confinement.own()


def command_of(process: Process) -> tuple[str, ...]:
    """The command line of a process; a confined one reads its settings from standard input or by an absolute path."""
    confinement, file = process.confinement, process.settings_file
    if confinement is None:
        return process.command
    if file is None:
        return confinement.command(process.command)
    given = STANDARD_INPUT if confinement.is_isolated else str(file.absolute())
    return confinement.command(given if word == str(file) else word for word in process.command)


class ChildProcess(ProcessHandle):
    """A program launched by its command line."""

    def __init__(self, process: Process, log: Path) -> None:
        """Writes the settings, if any, before the launch."""
        write_settings_of(process)
        make_folder_of(process)
        environment, own = confinement_of(process)
        launcher = (sys.executable, "-I", "-S", leash.__file__, str(os.getpid()), json.dumps(own))
        with log.open("ab") as out, _standard_input(process).open("rb") as given:
            super().__init__(process, log, out.tell())
            self._popen = subprocess.Popen(
                [*launcher, *command_of(process)],
                **run_as(process.confinement.user if process.confinement is not None else None),
                stdin=given,
                stdout=out,
                stderr=subprocess.STDOUT,
                env={**environment, **inheritance_of(process.sockets)},
                pass_fds=[one.fileno() for one in process.sockets],
                process_group=0,
            )

    @property
    def pid(self) -> int:
        """Process id, which is also the id of its group."""
        return self._popen.pid

    def _poll(self) -> int | None:
        status = self._popen.poll()
        is_wrapped = self.process.confinement is not None and self.process.confinement.visible is not None
        if is_wrapped and status is not None and status - _SIGNAL_IN_BUBBLEWRAP in set(signal.Signals):
            return _SIGNAL_IN_BUBBLEWRAP - status
        return status


def _standard_input(process: Process) -> Path:
    is_isolated = process.confinement is not None and process.confinement.is_isolated
    return process.settings_file if is_isolated and process.settings_file is not None else Path(os.devnull)
