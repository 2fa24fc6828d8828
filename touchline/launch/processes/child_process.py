"""One launched process: it has its own process group and log, and does not outlive its supervisor."""

import os
import signal
import subprocess
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from coach_gateway.match.team_names import printable
from coach_gateway.ports import inheritance_of
from runtime.process.clock import Clock
from runtime.process.idle_time import core_wait_of
from runtime.process.leash import OwnConfinement, leashed
from runtime.process.process_log import message_of
from runtime.process.settings_file import STANDARD_INPUT, write_settings
from runtime.process.timing import POLL_S
from schemas.errors import os_errors
from touchline.launch.confinement.bubblewrap import run_as
from touchline.launch.processes.fork_server import ROBOTS
from touchline.launch.processes.process_table import Process

if TYPE_CHECKING:
    from robot_agent.process.forks import ForkRequest

_TAIL_BYTES = 8192
_SIGNAL_IN_BUBBLEWRAP = 128
"""bwrap ends with this and the number of the signal that ended its program."""
_SIGNALS_OF_LIMITS = {-signal.SIGXCPU: "cpu_time", -signal.SIGXFSZ: "file_size"}
"""Exit status → the limit for which the kernel ended a process."""


class ChildProcess:
    """A launched process, running or ended; it leads its own process group."""

    def __init__(self, process: Process, folder: Path) -> None:
        """Launch the process, which appends its output to the log of its name in `folder`.

        Raises:
            TouchlineError: its settings or its folder cannot be written, or there are too many processes.
        """
        self.process, self.log = process, folder / f"{process.name}.log"
        self._status: int | None = None
        self._is_given_up = False
        """It could not be killed, and nobody waits for it any more."""
        self._core_wait = 0.0
        _write_files_of(process)
        with self.log.open("ab") as out:
            self._log_start = out.tell()
        self._poll: Callable[[], int | None]
        pid = ROBOTS.fork(_fork_request(process, self.log)) if process.can_fork else None
        if pid is not None:
            self.pid, self._poll = pid, partial(ROBOTS.status, pid)
        else:
            with os_errors(process.name, "end other programs, or allow this user more processes"):
                popen = _popen(process, self.log)
            self.pid, self._poll = popen.pid, popen.poll

    def wait(self, seconds: float, clock: Clock) -> int | None:
        """Exit status; None if it still runs after this wall time in s."""
        deadline = clock.now() + seconds
        while self.status() is None and clock.now() < deadline:
            clock.sleep_until(clock.now() + POLL_S)
        return self.status()

    def status(self) -> int | None:
        """Exit status, negative for the signal that ended the process; None while running."""
        if self._status is None:
            self._status = _unwrapped(self.process, self._poll())
            if self._status is not None:
                self._signal_group(signal.SIGKILL)  # ends its descendants, too
                if self.process.confinement is not None:
                    self.process.confinement.remove_empty_folder()
        return -signal.SIGKILL if self._status is None and self._is_given_up else self._status

    def send(self, number: signal.Signals) -> None:
        """Send a signal to the process group, unless the process has ended; in bubblewrap, to all within."""
        if self._status is not None:
            return
        if self.process.confinement is not None and self.process.confinement.is_isolated:
            self._signal_within(number)
        else:
            self._signal_group(number)

    def core_wait(self) -> float:
        """Wall time in s in which it was ready and had no core so far: that of the thread that waited longest."""
        self._core_wait = max(self._core_wait, core_wait_of(self.pid))  # a thread that ends takes its time with it
        return self._core_wait

    def breach(self) -> str:
        """What the process did beyond its limits, with the remedy, if it has ended for that; empty if not."""
        limit = _SIGNALS_OF_LIMITS.get(self._status or 0)
        limits = self.process.confinement.limits if self.process.confinement is not None else None
        return limits.breach(limit) if limit is not None and limits is not None else ""

    def last_lines(self, count: int = 5) -> list[str]:
        """The last lines of this process's output: none empty, none of an earlier process, no control characters."""
        with self.log.open("rb") as log:
            size = self.log.stat().st_size
            start = self._log_start if self._log_start <= size else 0  # the log was cut meanwhile
            log.seek(max(start, size - _TAIL_BYTES))
            text = log.read().decode("utf-8", "replace")
        lines = [printable(part) for line in text.splitlines() for part in message_of(line).splitlines()]
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
        except PermissionError:  # it runs as another user, as by sudo, and ends when its host is gone
            self._is_given_up = number == signal.SIGKILL


def _write_files_of(process: Process) -> None:
    """Write the settings file of a process, if it has one, and make the working folder of a confined one.

    Raises:
        TouchlineError: that cannot be written.
    """
    with os_errors(None, f"{process.name} needs it"):
        if process.settings is not None and process.settings_file is not None:
            write_settings(process.settings, process.settings_file)
        if process.confinement is not None:
            process.confinement.make_folder()


def _environment_of(process: Process) -> dict[str, str]:
    """The whole environment of a process."""
    if process.confinement is None:
        return {**os.environ, **process.environment, **inheritance_of(process.sockets)}
    return process.confinement.environment(process.environment)


def _own_confinement(process: Process) -> OwnConfinement:
    """What a process applies to itself."""
    return process.confinement.own() if process.confinement is not None else {}


def _command_of(process: Process) -> tuple[str, ...]:
    """The command line of a process; a confined one reads its settings from standard input or by an absolute path."""
    confinement, file = process.confinement, process.settings_file
    if confinement is None:
        return process.command
    if file is None:
        return confinement.command(process.command)
    given = STANDARD_INPUT if confinement.is_isolated else str(file.absolute())
    return confinement.command(given if word == str(file) else word for word in process.command)


def _fork_request(process: Process, log: Path) -> "ForkRequest":
    """The request for a fork that does what the command line of the process says, `python -P -m MODULE …`."""
    *_, module, option, file = _command_of(process)
    return {
        "name": process.name,
        "module": module,
        "arguments": [option, file],
        "environment": _environment_of(process),
        "confinement": _own_confinement(process),
        "log": str(log.absolute()),
    }


def _popen(process: Process, log: Path) -> "subprocess.Popen[bytes]":
    confinement = process.confinement
    with log.open("ab") as out, _standard_input(process).open("rb") as given:
        return subprocess.Popen(
            [*leashed(_own_confinement(process)), *_command_of(process)],
            **run_as(confinement.user if confinement is not None else None),
            stdin=given,
            stdout=out,
            stderr=subprocess.STDOUT,
            env=_environment_of(process),
            pass_fds=[one.fileno() for one in process.sockets],
            process_group=0,
        )


def _standard_input(process: Process) -> Path:
    is_isolated = process.confinement is not None and process.confinement.is_isolated
    return process.settings_file if is_isolated and process.settings_file is not None else Path(os.devnull)


def _unwrapped(process: Process, status: int | None) -> int | None:
    """The exit status of a process, also where bwrap reports it."""
    is_wrapped = process.confinement is not None and process.confinement.is_isolated
    if is_wrapped and status is not None and status - _SIGNAL_IN_BUBBLEWRAP in set(signal.Signals):
        return _SIGNAL_IN_BUBBLEWRAP - status
    return status


def _children_of(pid: int) -> list[int]:
    try:
        return [int(word) for word in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:  # it has ended, or the kernel does not list them
        return []
