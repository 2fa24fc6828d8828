"""Deferrable work, done while a core is idle.

A lockstep match needs every core while its robots compute, and one core while the host steps the world. A recorder that
works at that time, and yields at once when a robot is woken, costs the match almost nothing (Linux, SCHED_IDLE). Where
other programs leave no core idle, such a thread makes no progress, and only a privileged process can restore its
policy. The work therefore moves between threads: one that has kept its policy takes over.
"""

import math
import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from pathlib import Path
from queue import SimpleQueue

from runtime.process.clock import WallClock
from runtime.process.timing import CORE_WAIT_S, IDLE_AGAIN_S

Step = Callable[[], bool]
"""Does a part of the work; returns whether that was the last."""
CoreWait = Callable[[], float | None]
"""Returns the wall time that the calling thread has waited for a core so far, in s; None if it is not known."""
CoreWaitMeter = Callable[[], AbstractContextManager[CoreWait]]
"""Opens the core wait of the calling thread."""


_now = WallClock.now
_thread_state = threading.local()


@contextmanager
def core_wait() -> Iterator[CoreWait]:
    """The time that this thread has waited for a core while ready to run, as the kernel reports it.

    The kernel's file stays open: opening it for each step would take a tenth of a recorder's CPU time.
    """
    try:
        descriptor = os.open("/proc/thread-self/schedstat", os.O_RDONLY)
    except OSError:
        yield lambda: None
        return
    try:
        yield lambda: _waited_s(os.pread(descriptor, 100, 0))
    finally:
        os.close(descriptor)


def core_wait_of(pid: int) -> float:
    """The wall time in s that one of the threads of a process has waited for a core, the longest; 0 if unknown."""
    longest = 0.0
    with suppress(OSError):  # the process has ended
        for task in Path(f"/proc/{pid}/task").iterdir():
            with suppress(OSError):  # the thread has ended
                longest = max(longest, _waited_s((task / "schedstat").read_bytes()) or 0.0)
    return longest


def _waited_s(schedstat: bytes) -> float | None:
    """The second figure of a thread's `schedstat`, in s."""
    try:
        return int(schedstat.split()[1]) * 1e-9
    except (ValueError, IndexError):
        return None


def run_in_idle_time(step: Step, *, retry_s: float = IDLE_AGAIN_S, meter: CoreWaitMeter = core_wait) -> None:
    """Run steps until the last: in idle time where this thread has the batch policy, otherwise in this thread.

    The error of a step ends the work and is raised here. Steps must not depend on the thread that runs them. Idle time
    is tried again on a busy machine after `retry_s` of wall time.
    """
    done = False
    while not done:
        idles = is_batch_scheduled() and _is_reported(meter)
        if idles:
            done = _IdleWorker(step, meter).work()
        again_at = _now() + retry_s if idles else math.inf
        while not done:
            done = step()
            if _now() >= again_at:
                break


def _is_reported(meter: CoreWaitMeter) -> bool:
    with meter() as waited_s:
        return waited_s() is not None


def start_thread(thread: threading.Thread) -> None:
    """Start a thread with the policy of the caller of `run_in_idle_time`, also from a step that runs in idle time."""
    idle: _IdleWorker | None = getattr(_thread_state, "idle", None)
    if idle is None:
        thread.start()
    else:
        idle.request_start(thread)


def is_batch_scheduled() -> bool:
    """Whether this thread has the batch policy, and may work in idle time."""
    return sys.platform == "linux" and os.sched_getscheduler(0) == os.SCHED_BATCH


class _IdleWorker:
    """A thread that works in idle time, for a waiting thread that has kept its policy."""

    def __init__(self, step: Step, meter: CoreWaitMeter) -> None:
        self._step = step
        self._meter = meter
        self._thread = threading.Thread(target=self._run, name="idle time", daemon=True)
        self._asked: SimpleQueue[tuple[threading.Thread, threading.Event] | None] = SimpleQueue()
        self._done = False
        self._error: BaseException | None = None

    def work(self) -> bool:
        """Run the thread until the work is done or there is too little idle time; returns whether it is done."""
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
        """Have the waiting thread start a thread, which would otherwise inherit the idle policy."""
        started = threading.Event()
        self._asked.put((thread, started))
        started.wait()

    def _run(self) -> None:
        _thread_state.idle = self
        try:
            with suppress(OSError):  # forbidden in some sandboxes
                os.sched_setscheduler(0, os.SCHED_IDLE, os.sched_param(0))
            with self._meter() as waited_s:
                self._work_while_idle(waited_s)
        except BaseException as error:  # raised again in the waiting thread
            self._error = error
        finally:
            self._asked.put(None)

    def _work_while_idle(self, waited_s: CoreWait) -> None:
        """Run steps until the last, or until one has waited too long for a core."""
        waited = waited_s() or 0.0
        while not self._done:
            self._done = self._step()
            before, waited = waited, waited_s() or 0.0
            if waited - before > CORE_WAIT_S:
                break
