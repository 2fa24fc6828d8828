"""Runs a function on many items in parallel, each in a fresh process: for matches and drills.

Nothing that a brain leaves in its modules reaches another match, memory does not grow with the number of matches, and
a process that dies costs its own match only.
"""

import os
import signal
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkServerProcess
from typing import Any, TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")
Poll = Callable[[], None]
"""Called by the function with each tick: it ends the process when those who wait for its result are gone."""

_POLL_TICKS = 100
"""Ticks between two checks of whether the result is still wanted."""


@dataclass(frozen=True, slots=True)
class DiedProcess:
    """In place of a result: the process ended before it had one."""

    reason: str


def cores() -> int:
    """The number of cores that this process may use."""
    return len(os.sched_getaffinity(0))


def run_in_processes(
    function: Callable[[Item, Poll], Result], items: Iterable[Item], jobs: int
) -> Generator[tuple[Item, Result | DiedProcess], None, None]:
    """Call the function with each item in up to `jobs` processes at a time; yields each result when it is there.

    Closing the generator ends the processes.
    """
    context = get_context("forkserver")
    context.set_forkserver_preload([function.__module__])
    waiting, running = iter(items), dict[Connection, tuple[Item, ForkServerProcess]]()
    with _ended(running):
        while True:
            for item in _next(waiting, jobs - len(running)):
                ours, theirs = context.Pipe()
                process = context.Process(target=_run, args=(function, item, theirs), daemon=True)
                process.start()
                theirs.close()
                running[ours] = item, process
            if not running:
                return
            for ready in wait(list(running)):
                assert isinstance(ready, Connection)
                item, process = running[ready]
                result = _result(process, ready)
                del running[ready]
                yield item, result


def _next(waiting: Iterator[Item], most: int) -> Iterator[Item]:
    """The next items, up to `most`."""
    for _, item in zip(range(most), waiting, strict=False):
        yield item


@contextmanager
def _ended(running: dict[Connection, tuple[Any, ForkServerProcess]]) -> Iterator[None]:
    try:
        yield
    finally:
        for connection, (_, process) in running.items():
            process.kill()
            process.join()
            connection.close()


def _result(process: ForkServerProcess, connection: Connection) -> Any:
    with closing(connection):
        try:
            result = connection.recv()
        except EOFError:
            process.join()
            status = process.exitcode or 0
            how = f"was ended by {signal.Signals(-status).name}" if status < 0 else f"ended with status {status}"
            return DiedProcess(f"its process {how}")
        process.join()
        return result


def _run(function: Callable[[Any, Poll], Any], item: Any, connection: Connection) -> None:
    """The process of an item."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that waits, which ends this one
    os.dup2(2, 1)  # what brains print is no part of the result
    result = function(item, partial(_poll, connection, [0]))
    with suppress(BrokenPipeError):  # the result is not wanted any more
        connection.send(result)


def _poll(connection: Connection, ticks: list[int]) -> None:
    ticks[0] += 1
    if ticks[0] % _POLL_TICKS == 0 and connection.poll():
        os._exit(1)
