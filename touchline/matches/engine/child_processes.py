"""Calls a function in a fresh process for each item: for matches and drills.

Nothing that a brain leaves in its modules reaches another match, memory does not grow with the number of matches, and
a process that dies costs its own match only.
"""

import os
import signal
import tempfile
import threading
from collections.abc import Callable, Generator, Iterable
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from contextlib import closing, suppress
from functools import partial
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.connection import wait as wait_for
from multiprocessing.context import ForkServerProcess
from pathlib import Path
from typing import Any, TypeVar

from robot_agent.brain_folders import added_folders, remove_folders
from touchline.matches.engine.process_note import ProcessNote, open_note, read_note

Item = TypeVar("Item")
Result = TypeVar("Result")
Poll = Callable[[], None]
"""Called by the function with each tick: it ends the process when those who wait for its result are gone."""

FORKED = "touchline-child"
"""What the names of these processes begin with."""
_PRELOAD = "touchline.matches.engine.preload"
"""What the fork server imports once for all processes; not imported here."""
_POLL_TICKS = 100
"""Ticks between two checks of whether the result is still wanted."""
_EXIT_STATUS = threading.Lock()
"""Held by who starts a process or reads an exit status: starting one reads the status of all that have ended, and of
two threads that read the same one, the second gets 255."""


class DiedProcessError(Exception):
    """The process ended before it had a result; one line."""

    def __init__(self, reason: str, status: int = 0, note: ProcessNote | None = None) -> None:
        """`status` is that of the process, negative for the signal that ended it; `note` is what it has left."""
        super().__init__(reason)
        self.status = status
        self.note = note or ProcessNote()


def cores() -> int:
    """The number of cores that this process may use."""
    return len(os.sched_getaffinity(0))


class ChildProcesses(Executor):
    """An executor that calls each function in a fresh process, with a function to poll as its last argument.

    A process that ends without a result raises `DiedProcessError`.
    """

    def __init__(self, jobs: int) -> None:
        """`jobs` is the number of processes at a time."""
        self._threads = ThreadPoolExecutor(jobs, "child")
        self._lock = threading.Lock()
        self._running: set[ForkServerProcess] = set()
        self._is_closed = False

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        """Call the function as soon as fewer than `jobs` processes run."""
        call = partial(_without_folders, added_folders(), partial(fn, *args, **kwargs))
        return self._threads.submit(self._call, call, fn.__module__)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the executor; with `cancel_futures` the processes that run are killed, too."""
        if cancel_futures:
            with self._lock:
                self._is_closed = True
                for process in self._running:
                    process.kill()
        self._threads.shutdown(wait, cancel_futures=cancel_futures)

    def _call(self, call: Callable[[Poll], Any], module: str) -> Any:
        context = get_context("forkserver")
        context.set_forkserver_preload([_PRELOAD, module])
        ours, theirs = context.Pipe()
        with closing(ours), tempfile.TemporaryDirectory(prefix="touchline-") as folder:
            process = context.Process(target=_run, args=(call, theirs, Path(folder)), name=FORKED)
            with self._lock:
                if self._is_closed:
                    raise DiedProcessError("it was not started any more")
                with _EXIT_STATUS:
                    process.start()
                self._running.add(process)
            theirs.close()
            try:
                result = ours.recv()
            except EOFError:
                status = _join(process)
                raise DiedProcessError(_end_of(status), status, read_note(Path(folder))) from None
            finally:
                _join(process)
                with self._lock:
                    self._running.discard(process)
        if isinstance(result, BaseException):
            raise result
        return result


def run_in_processes(
    function: Callable[[Item, Poll], Result], items: Iterable[Item], jobs: int
) -> Generator[tuple[Item, Result | DiedProcessError], None, None]:
    """Call the function with each item in up to `jobs` processes at a time; yields each result when it is there.

    Closing the generator ends the processes.
    """
    waiting, running = iter(items), dict[Future[Result], Item]()
    children = ChildProcesses(jobs)
    try:
        while True:
            for _, item in zip(range(jobs - len(running)), waiting, strict=False):
                running[children.submit(function, item)] = item
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                item = running.pop(future)
                error = future.exception()
                if error is not None and not isinstance(error, DiedProcessError):
                    raise error
                yield item, error if isinstance(error, DiedProcessError) else future.result()
    finally:
        children.shutdown(cancel_futures=True)


def _without_folders(folders: tuple[str, ...], call: Callable[[Poll], Result], poll: Poll) -> Result:
    """Call the function without the folders of brains that the process which waits has on its module path."""
    remove_folders(folders)
    return call(poll)


def _join(process: ForkServerProcess) -> int:
    """Wait for the end of a process; returns its exit status."""
    wait_for([process.sentinel])
    with _EXIT_STATUS:
        process.join()
        return process.exitcode or 0


def _end_of(status: int) -> str:
    how = f"was ended by {signal.Signals(-status).name}" if status < 0 else f"ended with status {status}"
    return f"its process {how}"


def _run(call: Callable[[Poll], Any], connection: Connection, folder: Path) -> None:
    """The process of an item; its note is in the folder."""
    open_note(folder)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that waits, which ends this one
    os.dup2(2, 1)  # what brains print is no part of the result
    try:
        result = call(partial(_poll, connection, [0]))
    except Exception as error:  # raised by the future, in the process that waits
        result = error
    with suppress(BrokenPipeError):  # the result is not wanted any more
        connection.send(result)


def _poll(connection: Connection, ticks: list[int]) -> None:
    ticks[0] += 1
    if ticks[0] % _POLL_TICKS == 0 and connection.poll():
        os._exit(1)
