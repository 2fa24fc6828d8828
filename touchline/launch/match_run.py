"""A whole match: launches, watches and ends its processes, and returns the result."""

import signal
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from types import FrameType, TracebackType
from typing import Self

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.lines import event_line
from schemas.bus.announcement import announcement_in
from schemas.bus.contract import Bus, BusError, ReceivedMessage
from schemas.bus.endpoint import DEFAULT_ENDPOINT, local_endpoint
from schemas.bus.zenoh.bus import open_client
from schemas.errors import MatchFailedError, TouchlineError
from schemas.messages.game import GameEvent, GameState
from schemas.messages.health import Health
from schemas.process.clock import Clock
from schemas.side import Side
from touchline.launch.child_process import ProcessHandle
from touchline.launch.fork_server import ForkServer
from touchline.launch.processes import ROBOT_ENVIRONMENT, MatchPlan, Process, client_processes, host_process
from touchline.launch.result import NOTABLE, MatchResult
from touchline.launch.supervisor import AFTER_THE_MATCH, AT_ONCE, Supervisor
from touchline.watch.screen import Screen
from touchline.watch.status_line import status_line

_POLL = 0.05
"""Wall time between polls of processes and bus, s."""
_LOOK = 0.01
"""Wall time between two looks for the announcement of a host that is starting, s."""
_LAST_MESSAGES = 5.0
"""Wall time for the host's last messages to arrive after its process has ended, s. They have all arrived when the link
closes, and it closes with the process: only an overloaded machine takes long."""
_WRONG_INPUT = 2


class InterruptedMatchError(Exception):
    """The match was interrupted by a signal; `number` is the signal's number."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


class StopSignals:
    """Within the block SIGINT and SIGTERM are stored instead of raised."""

    def __init__(self) -> None:
        self.received: int | None = None
        self._before: dict[int, object] = {}

    def __enter__(self) -> Self:
        for number in (signal.SIGINT, signal.SIGTERM):
            self._before[number] = signal.signal(number, self._note)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)  # type: ignore[arg-type]

    def _note(self, number: int, frame: FrameType | None) -> None:
        del frame
        self.received = self.received or number


class MatchRun:
    """One match from launch to result."""

    def __init__(
        self,
        plan: MatchPlan,
        screen: Screen,
        clock: Clock,
        losses: Callable[[MatchPlan], dict[str, int]],
        recorded: Callable[[MatchPlan], Iterable[ReceivedMessage]],
    ) -> None:
        """`losses` returns the losses of a finished recording, `recorded` its events and states of the game."""
        self._plan = plan
        self._screen = screen
        self._clock = clock
        self._losses = losses
        self._recorded = recorded
        self._robots = sum(len(plan.config.robots(side)) for side in Side)
        self._fork_server = ForkServer()
        self._supervisor = Supervisor([host_process(plan)], self._launch, clock)

    def play(self) -> MatchResult:
        """Play the match.

        Raises:
            InterruptedMatchError: SIGINT or SIGTERM; all processes have ended and the recording is finished.
            MatchFailedError: the host ended before full time, or the recording was lost.
            TouchlineError: the host could not start; the message is the host's.
        """
        with StopSignals() as stop:
            try:
                self._supervisor.start()
                self._fork_server.prepare(ROBOT_ENVIRONMENT)
                follower = self._follow(stop) if self._launch_clients(stop) else None
            except BaseException:
                self._supervisor.end(AT_ONCE)
                raise
            if follower is not None:  # without a host there is no match to record
                self._supervisor.end(AFTER_THE_MATCH, should_abort=lambda: stop.received is not None)
            self._supervisor.end(AT_ONCE)  # the remaining processes, after an interrupt
        if stop.received is not None:
            raise InterruptedMatchError(stop.received)
        return self._outcome(follower)

    def _launch(self, process: Process) -> ProcessHandle:
        return self._fork_server.launch(process, self._plan.folder / f"{process.name}.log")

    def _launch_clients(self, stop: StopSignals) -> bool:
        """Launch all other processes as soon as the host listens; False if it never does."""
        self._screen.status("waiting for the host")
        while self._poll_processes(stop):
            announcement = announcement_in(self._plan.announcement)
            if announcement is not None:
                is_unexpected = announcement.endpoint != local_endpoint(self._plan.listen or DEFAULT_ENDPOINT)
                self._screen.event(f'match "{announcement.match}" on {announcement.endpoint}', notable=is_unexpected)
                self._plan = replace(self._plan, listen=announcement.endpoint)
                self._supervisor.add(client_processes(self._plan))
                return True
            self._clock.sleep_until(self._clock.now() + _LOOK)
        return False

    def _follow(self, stop: StopSignals) -> MatchFollower | None:
        """Watch until the host has ended or a signal is received; None if the host was never reached."""
        bus = self._connect(stop)
        if bus is None:
            return None
        with bus:
            follower = MatchFollower(bus)
            while self._poll_processes(stop):
                self._show(follower)
                self._clock.sleep_until(self._clock.now() + _POLL)
            deadline = self._clock.now() + _LAST_MESSAGES
            while stop.received is None and bus.connected() and self._clock.now() < deadline:
                self._clock.sleep_until(self._clock.now() + _POLL / 10)
            self._show(follower)
        return follower

    def _connect(self, stop: StopSignals) -> Bus | None:
        while self._poll_processes(stop):
            self._screen.status("waiting for the host")
            try:
                return open_client(self._plan.config.name, self._clock, self._plan.connect, patience=0.0)
            except BusError:
                self._clock.sleep_until(self._clock.now() + _POLL)
        return None

    def _poll_processes(self, stop: StopSignals) -> bool:
        for notice in self._supervisor.check():
            self._screen.warn(notice.sentence)
            for line in notice.log:
                self._screen.warn(f"  {notice.name}: {line}")
        return self._supervisor.host_status is None and stop.received is None

    def _show(self, follower: MatchFollower) -> None:
        self._report(follower, follower.update().messages)

    def _report(self, follower: MatchFollower, news: Sequence[GameEvent | GameState | Health]) -> None:
        for message in news:
            if isinstance(message, GameEvent):
                self._screen.event(event_line(message), notable=message.kind in NOTABLE)
        self._screen.status(status_line(follower, self._robots))

    def _outcome(self, follower: MatchFollower | None) -> MatchResult:
        """The result; raises the reason if there is none."""
        status = self._supervisor.host_status
        if status == 0 and follower is not None and not follower.finished:
            # this process may have missed the last messages if it was stalled; the host waits for the recorder
            self._report(follower, follower.merge_recorded(self._recorded(self._plan)))
        if status == 0 and follower is not None and follower.finished:
            return self._result(follower)
        log = self._supervisor.last_lines("host")
        if status == _WRONG_INPUT and log:
            raise TouchlineError(log[-1].removeprefix("touchline: "))
        for line in log:
            self._screen.warn(f"  host: {line}")
        how = "was ended before full time" if status == 0 else f"ended with status {status}"
        raise MatchFailedError(f"match abandoned: the host {how}; its log is {self._plan.folder / 'host.log'}")

    def _result(self, follower: MatchFollower) -> MatchResult:
        recording = self._plan.recording
        snapshots = self._plan.config.record.snapshot is not None  # a match without a goal has none
        missing = not snapshots and not self._plan.recording_files
        if recording is not None and (self._supervisor.ended.get("recorder") != 0 or missing):
            log = self._supervisor.last_lines("recorder")
            raise MatchFailedError(
                f"the match was played but its recording was lost: {log[-1] if log else 'no reason logged'}; "
                f"its log is {self._plan.folder / 'recorder.log'}"
            )
        return MatchResult.of(follower, recording, self._losses(self._plan))
