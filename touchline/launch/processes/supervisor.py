"""Supervises the processes of a match: launches them, restarts crashed agents, and ends all processes in order.

Independent of bus and screen; the clock and the launch function are parameters.
"""

import signal
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from robot_agent.process.settings import FIRST_SIGHT_FAILED
from runtime.process.clock import Clock
from runtime.process.ending import ending
from runtime.process.settings_file import WRONG
from runtime.process.timing import GIVE_UP_S, PARTING_S, POLL_S, RECONNECT_S, REPLY_S
from schemas.errors import TouchlineError
from touchline.launch.processes.child_process import ChildProcess
from touchline.launch.processes.process_table import Process, ProcessKind
from touchline.timing import HOST_ENDS_S, PROGRAM_ENDS_S


@dataclass(frozen=True, slots=True)
class Notice:
    """A notice about a process for the user: one sentence, and the last lines of the log."""

    name: str
    sentence: str
    log: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class EndStep:
    """A step of the shutdown: after this many seconds the running processes of these kinds receive this signal."""

    after: float
    kinds: frozenset[ProcessKind]
    number: signal.Signals
    since_host: bool = False
    """The time counts from the end of the host, not from the beginning of the shutdown."""
    is_work: bool = False
    """Time in which the processes were ready and had no core does not count: a busy machine cuts nothing short."""


_ALL = frozenset(ProcessKind)

_RECONNECTING = frozenset({ProcessKind.AGENT, ProcessKind.PAGE, ProcessKind.BRIDGES})
"""Kinds of processes that would wait for an ended host to return."""

_RECORDER_S = RECONNECT_S + GIVE_UP_S
"""A recorder takes at most this to reconnect, and to give up batches that the ended host no longer sends."""

AFTER_THE_MATCH = (
    EndStep(0.0, _RECONNECTING, signal.SIGTERM),
    EndStep(PROGRAM_ENDS_S, _RECONNECTING, signal.SIGKILL, is_work=True),
    EndStep(_RECORDER_S, frozenset({ProcessKind.RECORDER}), signal.SIGTERM, is_work=True),
    EndStep(_RECORDER_S + PARTING_S, _ALL, signal.SIGKILL, is_work=True),
)
"""The host has ended by itself: processes that would wait for its return are signalled; the recorder may finish."""

ABANDONED = (
    EndStep(0.0, frozenset({ProcessKind.HOST}), signal.SIGTERM),
    EndStep(REPLY_S, frozenset({ProcessKind.RECORDER}), signal.SIGTERM, since_host=True),
    *AFTER_THE_MATCH,
)
"""The match cannot go on, or its host has failed: the recorder has what the host published, and is not left to wait for
its return. The host ends after its tick, the others as after a match."""

AT_ONCE = (
    EndStep(0.0, frozenset({ProcessKind.HOST}), signal.SIGTERM),
    EndStep(HOST_ENDS_S, _RECONNECTING, signal.SIGTERM),
    EndStep(2 * HOST_ENDS_S, frozenset({ProcessKind.RECORDER}), signal.SIGTERM),
    EndStep(2 * HOST_ENDS_S + PROGRAM_ENDS_S, _ALL, signal.SIGKILL, is_work=True),
)
"""Interrupted: the host ends first, the recorder has most of the time to finish its file; within two seconds in all, in
which waits for a core do not count."""

_LEFT_EARLY = "ended with status 0 before the match was over; a robot's program runs until it receives SIGTERM"


class Supervisor:
    """The processes of one match, from launch to end."""

    def __init__(self, processes: Sequence[Process], launch: Callable[[Process], ChildProcess], clock: Clock) -> None:
        self._processes = {process.name: process for process in processes}
        self._launch = launch
        self._clock = clock
        self._running: dict[str, ChildProcess] = {}
        self._restarts: Counter[str] = Counter()
        self.ended: dict[str, int] = {}
        """Name → exit status of the processes that ended and were not restarted, in the order in which they ended."""
        self._crashes: dict[str, tuple[int, list[str]]] = {}
        """Name → exit status and last lines of the newest crash after which a process was restarted."""

    def start(self) -> None:
        """Launch all processes, in their order."""
        self.add([*self._processes.values()])

    def add(self, processes: Sequence[Process]) -> None:
        """Launch further processes, in their order."""
        for process in processes:
            self._processes[process.name] = process
            self._running[process.name] = self._launch(process)

    @property
    def logs(self) -> list[Path]:
        """The logs of all processes launched so far."""
        return [launched.log for launched in self._running.values()]

    def check(self) -> list[Notice]:
        """Poll all processes once; restart ended ones if the table allows it."""
        self._reap("host")  # first, so that no process is restarted after the host has ended
        notices = []
        for name, process in self._processes.items():
            if name in self.ended:
                continue
            if (status := self._running[name].status()) is None:
                continue
            if self.host_status is not None or (status == 0 and process.kind is not ProcessKind.AGENT):
                self.ended[name] = status
            elif status == 0:
                self.ended[name] = status
                notices.append(Notice(name, f"{name} {_LEFT_EARLY}", tuple(self._running[name].last_lines())))
            else:
                notices.append(self._crashed(process, status))
        return notices

    @property
    def host_status(self) -> int | None:
        """The host's exit status; None while running."""
        return self.ended.get("host")

    def has_no_robot(self, names: Sequence[str]) -> bool:
        """Whether none of these robots runs, or will run again. After the host has ended: whether all of them failed.

        Programs that end when their host has ended are no failures.
        """
        if self.host_status is None:
            return bool(names) and all(name in self.ended for name in names)
        ended = [(self._processes[name], self.ended[name]) for name in names if name in self.ended]
        return len(ended) == len(names) > 0 and all(_failed_at_first_sight(*end) for end in ended)

    def last_lines(self, name: str) -> list[str]:
        """The last lines of a process's log."""
        return self._running[name].last_lines() if name in self._running else []

    def reason(self, name: str) -> str:
        """Why a process has ended: the last line of its log, or else its exit status."""
        log, status = self.last_lines(name), self.ended.get(name)
        how = f"it {ending(status)} and " if status is not None else ""
        return log[-1].removeprefix("touchline: ") if log else f"{how}logged nothing"

    def failure(self, name: str) -> tuple[int | None, list[str]]:
        """Exit status and last lines of a process: None and none if it was not started.

        A process that was restarted and failed after the end of the host found no host any more. Its failure is the
        crash after which it was restarted.
        """
        ends, status = list(self.ended), self.ended.get(name)
        if status and name in self._crashes and "host" in ends[: ends.index(name)]:
            return self._crashes[name]
        return status, self.last_lines(name)

    def end(
        self,
        steps: Sequence[EndStep],
        should_abort: Callable[[], bool] = lambda: False,
        keep: frozenset[ProcessKind] = frozenset(),
    ) -> None:
        """End all processes by these steps; returns when all have ended, or as soon as `should_abort()` is true.

        Processes of the kinds `keep` go on.
        """
        began, host_ended = self._clock.now(), float("inf")
        waited = {name: running.core_wait() for name, running in self._running.items()}
        waiting = list(steps)
        while self._still_running(keep) and not should_abort():
            now = self._clock.now()
            if self.host_status is not None:
                host_ended = min(host_ended, now)
            due = [
                step
                for step in waiting
                if step.after + self._core_wait(step, waited) <= now - (host_ended if step.since_host else began)
            ]
            waiting = [step for step in waiting if step not in due]
            for step in due:
                self._signal(step, keep)
            self._clock.sleep_until(self._clock.now() + POLL_S)

    def _core_wait(self, step: EndStep, before: dict[str, float]) -> float:
        """The longest that a process of the step has waited for a core since `before`, in s; 0 where that counts."""
        kinds = step.kinds if step.is_work else ()
        return max(
            (
                self._running[name].core_wait() - waited
                for name, waited in before.items()
                if name not in self.ended and self._processes[name].kind in kinds
            ),
            default=0.0,
        )

    def _still_running(self, keep: frozenset[ProcessKind]) -> bool:
        for name in self._running:
            self._reap(name)
        return any(name not in self.ended and self._processes[name].kind not in keep for name in self._running)

    def _reap(self, name: str) -> None:
        if name in self._running and name not in self.ended and (status := self._running[name].status()) is not None:
            self.ended[name] = status

    def _signal(self, step: EndStep, keep: frozenset[ProcessKind]) -> None:
        for name, running in self._running.items():
            if name not in self.ended and self._processes[name].kind in step.kinds - keep:
                running.send(step.number)

    def _crashed(self, process: Process, status: int) -> Notice:
        log = tuple(self._running[process.name].last_lines())
        breach = self._running[process.name].breach()
        how = "failed at its first sight" if _failed_at_first_sight(process, status) else ending(status)
        how = f"was ended: {breach}" if breach else how
        return Notice(process.name, f"{process.name} {how}; {self._restart(process, status)}", log)

    def _restart(self, process: Process, status: int) -> str:
        """Launch a crashed process again if that is allowed and possible; returns what was done."""
        fails_always = _failed_at_first_sight(process, status) and not self._restarts[process.name]
        fails_always = fails_always or _cannot_begin(process, status)
        if self._restarts[process.name] < process.restarts and not fails_always:
            self._restarts[process.name] += 1
            self._crashes[process.name] = status, self.last_lines(process.name)
            try:
                self._running[process.name] = self._launch(process)
            except (TouchlineError, OSError) as error:  # a full disk
                self.ended[process.name] = status
                return f"cannot be started again: {error}"
            return f"started again ({self._restarts[process.name]} of {process.restarts})"
        self.ended[process.name] = status
        return "not started again"


def _failed_at_first_sight(process: Process, status: int | None) -> bool:
    """Whether a brain failed at its first sight; a team's own program may use the same status."""
    return process.settings is not None and status == FIRST_SIGHT_FAILED


def _cannot_begin(process: Process, status: int) -> bool:
    """Whether a robot cannot begin: its host refuses it, or its brain cannot be built."""
    return process.settings is not None and process.kind is ProcessKind.AGENT and status == WRONG
