"""Work that can wait, done while a core has nothing else to do.

A lockstep match needs every core while its robots think, and one while the host moves the world. A recorder that works
then, and gives way at once when a robot is woken, costs the match next to nothing (Linux, SCHED_IDLE). But where other
programs leave no core idle, such a thread stands still, and the kernel lets nobody but the privileged take it out of
that state again. So the work goes from thread to thread: one that kept its rank takes over.
"""

import math
import os
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from queue import SimpleQueue

Step = Callable[[], bool]
"""Does some of the work; whether that was all."""
CoreWait = Callable[[], float | None]
"""Wall time that the calling thread has waited for a core so far, s; None if it is not known."""

_MAX_WAIT_S = 0.25
"""Wall time that a step may wait for a core: among a dozen processes of a match on two cores it is a tenth of that."""
_RETRY_S = 30.0
"""Wall time after which a machine that was busy is tried again."""

_thread_state = threading.local()


def core_wait_s() -> float | None:
    """Return how long this thread has been ready to run while others had the cores, s; None if no kernel reports it."""
    try:
        return int(Path("/proc/thread-self/schedstat").read_text().split()[1]) * 1e-9
    except (OSError, ValueError, IndexError):
        return None


def run_in_idle_time(step: Step, *, retry_s: float = _RETRY_S, waited_s: CoreWait = core_wait_s) -> None:
    """Do step after step until one was the last: in idle time where this thread takes turns, else here.

    A step that fails ends it, and its error is raised here. It must not matter which thread does a step. A machine that
    was busy is tried again after `retry_s` of wall time; `waited_s` reports how long the calling thread waited for a
    core.
    """
    done = False
    while not done:
        idles = is_batch_scheduled() and waited_s() is not None
        if idles:
            done = _IdleWorker(step, waited_s).work()
        again_at = time.monotonic() + retry_s if idles else math.inf
        while not done:
            done = step()
            if time.monotonic() >= again_at:
                break


def start_thread(thread: threading.Thread) -> None:
    """Start a thread that has the rank of who asked for the work, also from a step that is done in idle time."""
    idle: _IdleWorker | None = getattr(_thread_state, "idle", None)
    if idle is None:
        thread.start()
    else:
        idle.request_start(thread)


def is_batch_scheduled() -> bool:
    """Whether this thread takes turns, and may do work in idle time."""
    return sys.platform == "linux" and os.sched_getscheduler(0) == os.SCHED_BATCH


class _IdleWorker:
    """A thread that works in idle time, and the one that waits for it and has kept its rank."""

    def __init__(self, step: Step, waited_s: CoreWait) -> None:
        self._step = step
        self._waited_s = waited_s
        self._thread = threading.Thread(target=self._run, name="idle time", daemon=True)
        self._asked: SimpleQueue[tuple[threading.Thread, threading.Event] | None] = SimpleQueue()
        self._done = False
        self._error: BaseException | None = None

    def work(self) -> bool:
        """Have it work until all is done, or there is too little idle time; returns whether all is done."""
        self._thread.start()
        while (asked := self._asked.get()) is not None:
            thread, started = asked
            thread.start()
            started.set()
        self._thread.join()
        if self._error is not None:
            raise self._error
        return self._done

    def request_start(self, thread: threading.Thread) -> None:
        """Let the one who waits start a thread: it would inherit this one's rank."""
        started = threading.Event()
        self._asked.put((thread, started))
        started.wait()

    def _run(self) -> None:
        _thread_state.idle = self
        try:
            with suppress(OSError):  # a sandbox forbids it
                os.sched_setscheduler(0, os.SCHED_IDLE, os.sched_param(0))
            waited = self._waited_s() or 0.0
            while not self._done:
                self._done = self._step()
                before, waited = waited, self._waited_s() or 0.0
                if waited - before > _MAX_WAIT_S:
                    break
        except BaseException as error:  # raised again where the work was asked for
            self._error = error
        finally:
            self._asked.put(None)
