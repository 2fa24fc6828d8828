"""Keeps the processes of a match: launches them, restarts agents that crash, and ends all of them in order.

Knows neither bus nor screen; the clock and the way to launch are given to it.
"""

import signal
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from schemas.process.clock import Clock
from touchline.launch.processes import Process, ProcessKind


class RunningProcess(Protocol):
    """A launched process, as `touchline.launch.child_process.ChildProcess` is one."""

    def status(self) -> int | None:
        """Exit status, negative for a signal; nothing while it runs."""

    def send(self, number: signal.Signals) -> None:
        """Send a signal, unless it has ended."""

    def last_lines(self, count: int = 5) -> list[str]:
        """The end of its log."""


@dataclass(frozen=True, slots=True)
class Notice:
    """Something people should know of a process: one sentence, and the last lines of its log."""

    name: str
    sentence: str
    log: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class EndStep:
    """After so many seconds of ending, who still runs gets this signal."""

    after: float
    kinds: frozenset[ProcessKind]
    number: signal.Signals


_ALL = frozenset(ProcessKind)

_RECONNECTING = frozenset({ProcessKind.AGENT, ProcessKind.PAGE, ProcessKind.BRIDGES})
"""Who would wait for a host that has gone to come back."""

AFTER_THE_MATCH = (
    EndStep(0.0, _RECONNECTING, signal.SIGTERM),
    EndStep(1.5, _RECONNECTING, signal.SIGKILL),
    EndStep(30.0, frozenset({ProcessKind.RECORDER}), signal.SIGTERM),
    EndStep(35.0, _ALL, signal.SIGKILL),
)
"""The host has ended by itself: who would wait for it to come back is told; the recorder may finish."""

AT_ONCE = (
    EndStep(0.0, frozenset({ProcessKind.HOST}), signal.SIGTERM),
    EndStep(0.2, _RECONNECTING, signal.SIGTERM),
    EndStep(0.4, frozenset({ProcessKind.RECORDER}), signal.SIGTERM),
    EndStep(1.8, _ALL, signal.SIGKILL),
)
"""Somebody ends it: the host goes first, the recorder has most of the time to finish its file; all in two seconds."""

_POLL = 0.02


class Supervisor:
    """The processes of one match, from launch to end."""

    def __init__(self, processes: Sequence[Process], launch: Callable[[Process], RunningProcess], clock: Clock) -> None:
        self._processes = {process.name: process for process in processes}
        self._launch = launch
        self._clock = clock
        self._running: dict[str, RunningProcess] = {}
        self._restarts = dict.fromkeys(self._processes, 0)
        self.ended: dict[str, int] = {}
        """Name → exit status of those that ended and were not started again."""

    def start(self) -> None:
        """Launch all, in the order of the table."""
        for name, process in self._processes.items():
            self._running[name] = self._launch(process)

    def check(self) -> list[Notice]:
        """Look after everybody once: what ended is noticed, and started again where the table says so."""
        self._reap("host")  # first, so that nobody is restarted for a host that is gone
        notices = []
        for name, process in self._processes.items():
            if name in self.ended:
                continue
            status = self._running[name].status()
            if status is None:
                continue
            if status == 0 or self.host_status is not None:
                self.ended[name] = status
            else:
                notices.append(self._crashed(process, status))
        return notices

    @property
    def host_status(self) -> int | None:
        """The host's exit status; nothing while it runs."""
        return self.ended.get("host")

    def last_lines(self, name: str) -> list[str]:
        """The end of a process's log."""
        return self._running[name].last_lines() if name in self._running else []

    def end(self, steps: Sequence[EndStep], hurried: Callable[[], bool] = lambda: False) -> None:
        """End everybody by these steps; returns when all have gone, or as soon as somebody is `hurried`."""
        began = self._clock.now()
        waiting = list(steps)
        while self._still_running() and not hurried():
            elapsed = self._clock.now() - began
            while waiting and waiting[0].after <= elapsed:
                self._signal(waiting.pop(0))
            self._clock.sleep_until(self._clock.now() + _POLL)

    def _still_running(self) -> bool:
        for name in self._running:
            self._reap(name)
        return len(self.ended) < len(self._running)

    def _reap(self, name: str) -> None:
        if name in self._running and name not in self.ended:
            status = self._running[name].status()
            if status is not None:
                self.ended[name] = status

    def _signal(self, step: EndStep) -> None:
        for name, running in self._running.items():
            if name not in self.ended and self._processes[name].kind in step.kinds:
                running.send(step.number)

    def _crashed(self, process: Process, status: int) -> Notice:
        log = tuple(self._running[process.name].last_lines())
        left = process.restarts - self._restarts[process.name]
        if left > 0:
            self._restarts[process.name] += 1
            self._running[process.name] = self._launch(process)
            outcome = f"started again ({self._restarts[process.name]} of {process.restarts})"
        else:
            self.ended[process.name] = status
            outcome = "not started again"
        return Notice(process.name, f"{process.name} {_ending(status)}; {outcome}", log)


def _ending(status: int) -> str:
    if status < 0:
        return f"was ended by {signal.Signals(-status).name}"
    return f"ended with status {status}"
