"""Plays matches in parallel, each in a fresh process.

Nothing that a brain leaves in its modules reaches another match, memory does not grow with the number of matches, and
a process that dies costs its own match only.
"""

import os
import signal
from collections.abc import Generator, Iterable, Iterator
from contextlib import closing, contextmanager, suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkServerProcess

from touchline.series.plan import PlannedMatch
from touchline.series.play_planned import Outcome, failed, play_planned

_POLL_TICKS = 100
"""Ticks between two checks of whether the series still runs."""


def cores() -> int:
    """The number of cores that this process may use."""
    return len(os.sched_getaffinity(0))


def play_in_processes(matches: Iterable[PlannedMatch], jobs: int) -> Generator[Outcome, None, None]:
    """Play matches in up to `jobs` processes at a time; yields each as it ends.

    Closing the iterator ends the processes.
    """
    context = get_context("forkserver")
    context.set_forkserver_preload([__name__])
    waiting, running = iter(matches), dict[Connection, tuple[PlannedMatch, ForkServerProcess]]()
    with _ended(running):
        while True:
            while len(running) < jobs and (planned := next(waiting, None)) is not None:
                ours, theirs = context.Pipe()
                process = context.Process(target=_run, args=(planned, theirs), daemon=True)
                process.start()
                theirs.close()
                running[ours] = planned, process
            if not running:
                return
            for ready in wait(list(running)):
                assert isinstance(ready, Connection)
                planned, process = running[ready]
                outcome = _outcome(planned, process, ready)
                del running[ready]
                yield outcome


@contextmanager
def _ended(running: dict[Connection, tuple[PlannedMatch, ForkServerProcess]]) -> Iterator[None]:
    try:
        yield
    finally:
        for connection, (_, process) in running.items():
            process.kill()
            process.join()
            connection.close()


def _outcome(planned: PlannedMatch, process: ForkServerProcess, connection: Connection) -> Outcome:
    with closing(connection):
        try:
            outcome: Outcome = connection.recv()
        except EOFError:
            process.join()
            status = process.exitcode or 0
            how = f"was ended by {signal.Signals(-status).name}" if status < 0 else f"ended with status {status}"
            reason = f"the process of the match {how}"
            return failed(planned, reason)
        process.join()
        return outcome


def _run(planned: PlannedMatch, connection: Connection) -> None:
    """The process of a match: it ends early when the series has ended."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the series, which ends this process
    os.dup2(2, 1)  # what brains print is no part of the result
    ticks = 0

    def poll() -> None:
        nonlocal ticks
        ticks += 1
        if ticks % _POLL_TICKS == 0 and connection.poll():
            os._exit(1)

    outcome = play_planned(planned, poll)
    with suppress(BrokenPipeError):  # the series has ended
        connection.send(outcome)
