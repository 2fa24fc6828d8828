"""A whole match: launches, watches and ends its processes, and returns the result."""

import shutil
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.lines import clock_text
from coach_gateway.match.team_names import TeamNames
from runtime.access.accounts import Account
from runtime.bus.announcement import announcement_in
from runtime.bus.contract import Bus, BusError
from runtime.bus.outcome_file import read_outcome
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import Clock
from runtime.process.ending import ending
from runtime.process.settings_file import WRONG
from runtime.process.timing import PARTING_S
from schemas.config.confinement import Isolation
from schemas.errors import MatchFailedError, TouchlineError
from schemas.messages.recorder import RecorderProgress
from schemas.side import Side
from schemas.topics import RECORDER_PROGRESS
from touchline.launch.match_screen import MatchScreen
from touchline.launch.page import address_lines
from touchline.launch.processes.child_process import ChildProcess
from touchline.launch.processes.fork_server import ROBOTS
from touchline.launch.processes.log_notes import LogWatch
from touchline.launch.processes.process_table import ProcessKind
from touchline.launch.processes.programs import MatchPlan, client_processes, host_process
from touchline.launch.processes.stop_signals import StopSignals
from touchline.launch.processes.supervisor import ABANDONED, AFTER_THE_MATCH, AT_ONCE, Supervisor
from touchline.launch.recording_outcome import outcome_of
from touchline.launch.remote_teams import RemoteTeams
from touchline.launch.result import MatchResult
from touchline.launch.team_error import TeamLeftError
from touchline.launch.terminal.screen import Screen
from touchline.timing import PAGE_CLOSES_S, POLL_S

if TYPE_CHECKING:
    from coach_gateway.web.pages.protocol import ResultUpdate

_AFTER_THE_RESULT = frozenset({ProcessKind.PAGE})
"""Processes that go on after the match, until the page with its result is closed."""
_NONE: frozenset[ProcessKind] = frozenset()


class InterruptedMatchError(Exception):
    """The match was interrupted by a signal; `number` is the signal's number."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


class MatchRun:
    """One match from launch to result."""

    def __init__(self, plan: MatchPlan, screen: Screen, clock: Clock, check: Callable[[], None] = lambda: None) -> None:
        """`check` is called while the host starts; what it raises ends the match."""
        self._plan = plan
        self._screen = screen
        self._clock = clock
        self._check = check
        self._has_clients = self._is_recorder_dismissed = self._is_over = False
        self._names = TeamNames.of_match(plan.config)
        self._remote = RemoteTeams(plan.config)
        self._match_screen = MatchScreen(plan, screen, self._remote, clock)
        self._log_watch = LogWatch(screen)
        self._supervisor = Supervisor([host_process(plan)], partial(ChildProcess, folder=plan.folder), clock)

    def play(self) -> MatchResult:
        """Play the match.

        Raises:
            InterruptedMatchError: SIGINT or SIGTERM; all processes have ended and the recording is finished.
            TeamLeftError: a team has no robot left.
            MatchFailedError: the host ended before full time.
            TouchlineError: the host could not start; the message is the host's.
        """
        with StopSignals() as stop:
            try:
                self._supervisor.start()
                if self._plan.config.isolate is Isolation.NONE:
                    ROBOTS.prepare()
                self._check()
                follower = self._follow(stop) if self._launch_clients(stop) else None
                empty = self._empty_side()
            except BaseException:
                self._supervisor.end(AT_ONCE)
                raise
            if follower is not None:  # without a host there is no match to record
                is_over = self._supervisor.host_status == 0
                steps, keep = (AFTER_THE_MATCH, _AFTER_THE_RESULT) if is_over else (ABANDONED, _NONE)
                self._supervisor.end(steps, should_abort=lambda: stop.received is not None, keep=keep)
            if follower is None or empty is not None or stop.received is not None:
                self._supervisor.end(AT_ONCE)  # the remaining processes
            self._log_watch.count()
        if stop.received is not None:
            raise InterruptedMatchError(stop.received)
        try:
            if empty is not None:
                has_begun = follower is not None and follower.state is not None
                raise TeamLeftError(empty, self._abandonment(empty, follower), has_begun=has_begun)
            return self._outcome(follower)
        except BaseException:
            self._supervisor.end(AT_ONCE)
            raise

    def stay(self, result: "Iterable[ResultUpdate]") -> None:
        """Keep the page with the result of the match until it is closed everywhere, or until SIGINT or SIGTERM.

        `result` is what the page is given, one piece after another while the page is open.
        """
        from coach_gateway.web.pages.match_result import write_result

        with StopSignals() as stop:
            for part in result:
                write_result(self._plan.result_folder, part)
                if not self._page_is_open(stop, PAGE_CLOSES_S):
                    break
            while self._page_is_open(stop, POLL_S):
                pass
            self._supervisor.end(AT_ONCE)

    def _page_is_open(self, stop: StopSignals, seconds: float) -> bool:
        """Wait; whether the page's server runs on: it ends when no page is open."""
        self._clock.sleep_until(self._clock.now() + seconds)
        self._supervisor.check()
        return stop.received is None and "page" not in self._supervisor.ended

    def _launch_clients(self, stop: StopSignals) -> bool:
        """Launch all other processes as soon as the host listens; False if it never does."""
        while self._poll_processes(stop):
            if (announcement := announcement_in(self._plan.announcement)) is not None:
                self._match_screen.begin(announcement)
                if self._plan.page is not None:
                    for line in address_lines(self._plan.page.settings, self._plan.tokens):
                        self._screen.event(line, notable=False)
                self._plan = replace(self._plan, listen=announcement.endpoint)
                self._supervisor.add(client_processes(self._plan))
                self._has_clients = True
                return True
            self._clock.sleep_until(self._clock.now() + POLL_S)
        return False

    def _follow(self, stop: StopSignals) -> MatchFollower | None:
        """Watch until the host has ended or a signal is received; None if the host was never reached."""
        if (bus := self._connect(stop)) is None:
            return None
        with bus:
            follower = MatchFollower(bus)
            while self._poll_processes(stop):
                self._match_screen.update(follower)
                self._is_over = follower.finished
                self._clock.sleep_until(self._clock.now() + POLL_S)
            deadline = self._clock.now() + PARTING_S
            while self._is_ending(stop) and bus.connected() and self._clock.now() < deadline:
                self._clock.sleep_until(self._clock.now() + POLL_S)
            self._match_screen.update(follower)
        return follower

    def _connect(self, stop: StopSignals) -> Bus | None:
        while self._poll_processes(stop):
            self._screen.status("waiting for the host")
            try:
                credentials = self._plan.credentials_of(Account.VIEWER)
                return open_client(self._plan.config.name, self._clock, self._plan.connect, 0.0, credentials)
            except BusError:
                self._clock.sleep_until(self._clock.now() + POLL_S)
        return None

    def _poll_processes(self, stop: StopSignals) -> bool:
        if stop.received is not None:
            return False  # processes that end with the same signal are no crashes
        for log in self._supervisor.logs:
            self._log_watch.update(log)
        for notice in self._supervisor.check():
            self._log_watch.show(notice)
        if self._supervisor.ended.get("recorder") and self._supervisor.host_status is None:
            self._dismiss_recorder()
        return self._supervisor.host_status is None and self._empty_side() is None

    def _dismiss_recorder(self) -> None:
        """Tell the host that the recorder has failed for good: it would wait for its return, and again at the end."""
        if self._is_recorder_dismissed:
            return
        credentials = self._plan.credentials_of(Account.RECORDER)
        with (
            suppress(BusError),  # the host is busy or about to end; asked again at the next look
            open_client(self._plan.config.name, self._clock, self._plan.connect, 0.0, credentials) as bus,
        ):
            last = RecorderProgress(tick=-1, messages=0, lost=0, leaving=True)
            bus.publisher(RECORDER_PROGRESS, name="recorder").put(last)
            self._is_recorder_dismissed = True

    def _is_ending(self, stop: StopSignals) -> bool:
        """Whether the host has ended by itself, so that its last messages are on their way."""
        return stop.received is None and self._supervisor.host_status is not None

    def _empty_side(self) -> Side | None:
        """A side of which no robot is left, or has come; None while both play, and after full time."""
        if self._is_over:
            return None  # robots may give up a host that takes long to end
        if self._remote.absent is not None:
            return self._remote.absent
        processes = {side: [*self._plan.config.processes(side)] for side in Side}
        return next((side for side, names in processes.items() if self._supervisor.has_no_robot(names)), None)

    def _abandonment(self, side: Side, follower: MatchFollower | None) -> str:
        """Why a match ended, of which one side has no robot left."""
        if side is self._remote.absent:
            return self._remote.absence(side)
        state = follower.state if follower is not None else None
        when = (
            f"at {clock_text(state.clock)}, {self._names.score(state.score, state.value)}"
            if state is not None
            else "before it began"
        )
        first = next(iter(self._plan.config.processes(side)))
        return (
            f"match ended {when}: no robot of {self._names.with_side(side)} is left; "
            f"{first}: {self._supervisor.reason(first)}; logs are in {self._plan.folder}"
        )

    def _outcome(self, follower: MatchFollower | None) -> MatchResult:
        """The result; raises the reason if there is none."""
        status = self._supervisor.host_status
        if status == 0 and follower is not None and not follower.finished:
            # this process may have missed the last messages if it was stalled
            self._match_screen.report(follower, follower.merge_recorded(read_outcome(self._plan.outcome)))
        if status == 0 and follower is not None and follower.finished:
            recording = outcome_of(self._plan, *self._supervisor.failure("recorder"))
            return MatchResult.of(follower, recording, self._names)
        log = self._supervisor.last_lines("host")
        if status == WRONG and log:
            if not self._has_clients:
                shutil.rmtree(self._plan.folder)  # its log is the error that is reported
                with suppress(OSError):  # of other matches
                    self._plan.folder.parent.rmdir()
            raise TouchlineError(log[-1].removeprefix("touchline: "))
        for line in log:
            self._screen.warn(f"  host: {line}")
        how = ending(status) if status else "was ended before full time"
        raise MatchFailedError(f"match abandoned: the host {how}; its log is {self._plan.folder / 'host.log'}")
