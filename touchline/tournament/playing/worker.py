"""The process of one match: plays it in the way that is planned, and sends the outcome."""

import os
import signal
import time
from collections.abc import Generator
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkServerProcess

from touchline.tournament.cup_config import PROCESSES
from touchline.tournament.playing.outcome import FailureKind, Outcome
from touchline.tournament.playing.planned_match import PlannedMatch

_SIGN_S = 1.0
"""Wall time between two signs of life."""
_GRACE_S = 10.0
"""Wall time beyond the patience with a decision after which a process that holds even its threads up is killed."""


class Workers:
    """Up to `jobs` matches at a time, each in a fresh process; to be closed, which ends them all."""

    def __init__(self, jobs: int, patience: float) -> None:
        """`patience` is wall time for one decision in s."""
        self._context = get_context("forkserver")
        self._context.set_forkserver_preload(["touchline.tournament.playing.in_process"])
        self._jobs = jobs
        self._patience = patience
        self._running: dict[Connection, tuple[PlannedMatch, ForkServerProcess]] = {}
        self._alive: dict[Connection, float] = {}
        """When a process last gave a sign of life, in s of the monotonic clock."""

    @property
    def has_room(self) -> bool:
        """Whether another match can start."""
        return len(self._running) < self._jobs

    @property
    def running(self) -> list[PlannedMatch]:
        """The matches that are played now."""
        return [planned for planned, _ in self._running.values()]

    def start(self, planned: PlannedMatch) -> None:
        """Play a match."""
        ours, theirs = self._context.Pipe()
        process = self._context.Process(target=_run, args=(planned, self._patience, theirs))
        process.start()
        theirs.close()
        self._running[ours] = planned, process
        self._alive[ours] = time.monotonic()

    def ended(self) -> Generator[tuple[PlannedMatch, Outcome], None, None]:
        """Wait until a match has ended; yields all that have."""
        while self._running:
            found = False
            for ready in wait(list(self._running), timeout=1.0):
                assert isinstance(ready, Connection)
                outcome = self._received(ready)
                if outcome is not None:
                    found = True
                    yield self._running.pop(ready)[0], outcome
            for stuck in [one for one, at in self._alive.items() if time.monotonic() - at > self._patience + _GRACE_S]:
                planned, process = self._running.pop(stuck)
                self._end(stuck, process)
                found = True
                yield planned, Outcome.failed(FailureKind.WORKER, None, "its process gave no sign of life")
            if found:
                return

    def close(self) -> None:
        """End all matches that are played."""
        for connection, (_, process) in self._running.items():
            self._end(connection, process)
        self._running.clear()

    def _received(self, connection: Connection) -> Outcome | None:
        """The outcome of a process that has one; None for a sign of life."""
        process = self._running[connection][1]
        try:
            message = connection.recv()
        except (EOFError, OSError):
            process.join()
            status = process.exitcode or 0
            how = f"was ended by {signal.Signals(-status).name}" if status < 0 else f"ended with status {status}"
            message = Outcome.failed(FailureKind.WORKER, None, f"its process {how}")
        if message is None:
            self._alive[connection] = time.monotonic()
            return None
        assert isinstance(message, Outcome)
        self._end(connection, process, _GRACE_S)
        return message

    def _end(self, connection: Connection, process: ForkServerProcess, patience: float = 0.0) -> None:
        """End a process; one that has reported its outcome gets some time to end by itself."""
        self._alive.pop(connection, None)
        process.join(patience)
        process.kill()
        process.join()
        connection.close()


def _run(planned: PlannedMatch, patience: float, connection: Connection) -> None:
    """The process of a match."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that waits, which ends this one
    os.dup2(2, 1)  # what brains print is no part of the outcome
    last = time.monotonic()

    def report(outcome: Outcome) -> None:
        with suppress(BrokenPipeError):  # the outcome is not wanted any more
            connection.send(outcome)

    def poll() -> None:
        nonlocal last
        if time.monotonic() - last > _SIGN_S:
            last = time.monotonic()
            try:
                connection.send(None)
            except BrokenPipeError:
                os._exit(1)

    if planned.way == PROCESSES:
        from touchline.tournament.playing.with_processes import play_with_processes

        play_with_processes(planned, report, poll)
        return
    from touchline.tournament.playing.in_process import play_in_process

    play_in_process(planned, patience, report, poll)
