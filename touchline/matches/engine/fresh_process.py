"""Calls functions in fresh processes: nothing that a brain leaves in its modules reaches another match.

A process that dies or hangs costs its own match only.
"""

import multiprocessing
import os
import signal
import tempfile
import threading
from collections.abc import Callable
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from functools import partial
from multiprocessing.context import ForkServerContext
from pathlib import Path
from typing import Any

from pebble import ProcessExpired, concurrent

from robot_agent.loading.brain_folders import added_folders, remove_folders
from runtime.process.ending import ending
from touchline.matches.engine.hang_watch import Note, read_note
from touchline.timing import PROGRAM_ENDS_S

_PRELOAD = "touchline.matches.engine.preload"
"""What the fork server imports once for all processes; not imported here."""


class DiedProcessError(Exception):
    """The process ended before it had a result; one line."""

    def __init__(self, reason: str, status: int = 0, note: Note | None = None) -> None:
        """`status` is that of the process, negative for the signal that ended it; `note` is what it has left."""
        super().__init__(reason)
        self.status = status
        self.note = note or Note()


def cores() -> int:
    """The number of cores that this process may use."""
    return len(os.sched_getaffinity(0))


class FreshProcesses(Executor):
    """An executor that calls each function in a fresh process, with a folder for its note as its last argument.

    A process that ends without a result raises `DiedProcessError`.
    """

    def __init__(self, jobs: int) -> None:
        """`jobs` is the number of processes at a time."""
        self._context = multiprocessing.get_context("forkserver")
        self._context.Lock()  # starts multiprocessing's tracker of locks, which lets Ctrl-C through to what follows it
        self._threads = ThreadPoolExecutor(jobs, "match", _block_interrupts)
        self._lock = threading.Lock()
        self._name = f"match-{id(self)}"
        """The name of its processes."""
        self._is_closed = False

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        """Call the function as soon as fewer than `jobs` processes run."""
        call = partial(_without_folders, added_folders(), partial(fn, *args, **kwargs))
        return self._threads.submit(self._call, call, fn.__module__)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the executor; with `cancel_futures` the processes that run are ended, too."""
        if cancel_futures:
            with self._lock:
                self._is_closed = True
            # not by their futures: pebble's thread fails where a result has come just before
            running = [one for one in multiprocessing.active_children() if one.name == self._name]
            for process in running:
                process.terminate()
            for process in running:
                process.join(PROGRAM_ENDS_S)
                process.kill()
        self._threads.shutdown(wait, cancel_futures=cancel_futures)

    def _call(self, call: Callable[[Path], Any], module: str) -> Any:
        self._context.set_forkserver_preload([_PRELOAD, module])
        with tempfile.TemporaryDirectory(prefix="touchline-") as folder:
            with self._lock:
                if self._is_closed:
                    raise DiedProcessError("it was not started any more")
                process = _in_process(self._context, self._name)(call, Path(folder))
            try:
                return process.result()
            except ProcessExpired as error:
                status = error.exitcode or 0
                raise DiedProcessError(f"its process {ending(status)}", status, read_note(Path(folder))) from None
            finally:
                if self._is_closed:  # whatever a process makes of its signal
                    raise DiedProcessError("it was ended with the run")


def _block_interrupts() -> None:
    """Keep Ctrl-C from the fork server that this thread starts, which would print what it was importing."""
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})


def _in_process(context: ForkServerContext, name: str) -> "Callable[..., Future[Any]]":
    """Calls `_run` in a process, which may start others: it is no daemon."""
    options: dict[str, Any] = {"name": name, "daemon": False}
    options["context"] = context  # stubs of pebble name it differently
    decorated: Callable[..., Callable[..., Future[Any]]] = concurrent.process(**options)
    return decorated(_run)


def _run(call: Callable[[Path], Any], folder: Path) -> Any:
    """What the process does."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)  # pebble has it exit by itself, which would be a team's fault
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})  # the programs that it starts have it
    threading.Thread(target=_end_with_parent, daemon=True).start()
    os.dup2(2, 1)  # what brains print is no part of the result
    os.environ.setdefault("PYTHONBREAKPOINT", "0")  # nobody is at its terminal
    return call(folder)


def _end_with_parent() -> None:
    """End this process when those who wait for its result are gone."""
    if (parent := multiprocessing.parent_process()) is not None:
        parent.join()
        os._exit(1)


def _without_folders(folders: tuple[str, ...], call: Callable[[Path], Any], note: Path) -> Any:
    """Call the function without the folders of brains that the process which waits has on its module path."""
    remove_folders(folders)
    return call(note)
