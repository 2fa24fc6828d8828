"""Ends waits at their deadline: one thread for all readers of a session, started with the first such wait."""

import math
import threading
from typing import Protocol

from runtime.process.clock import Clock
from runtime.process.timing import WAKE_AGAIN_S


class Waiter(Protocol):
    """A reader that may wait."""

    deadline: float
    """The deadline of its wait, by the clock in s; infinite without a wait or without a deadline."""

    def wake(self) -> None:
        """End its wait."""


class WaitTimer:
    """Sleeps until the earliest deadline of its readers.

    A reader that begins a wait first sets its deadline, then reads `next_check_at`, and calls `check_now` where its
    deadline is earlier. Most waits are short and begin before the next check: they cost this comparison, and no lock.
    """

    def __init__(self, clock: Clock) -> None:
        self.next_check_at = math.inf
        """Time of the next check of all readers, by the clock in s; also infinite during a check."""
        self._clock = clock
        self._waiting: list[Waiter] = []
        self._thread: threading.Thread | None = None
        self._starting = threading.Lock()
        self._check_requested = threading.Event()
        self._stopping = False

    def add(self, reader: Waiter) -> None:
        """Watch this reader as well."""
        self._waiting.append(reader)

    def check_now(self) -> None:
        """Check all readers now: a wait has begun whose deadline is before the next check."""
        self._check_requested.set()
        if self._thread is None:
            self._start()

    def stop(self) -> None:
        """End the thread; later deadlines have no effect."""
        self._stopping = True
        self._check_requested.set()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()

    def _start(self) -> None:
        """Start the thread once, however many readers call this at the same time."""
        with self._starting:
            if self._thread is None:
                thread = threading.Thread(target=self._run, name="bus wait timer", daemon=True)
                thread.start()
                self._thread = thread  # only now: a signal within `start` must not leave a thread that cannot be joined

    def _run(self) -> None:
        while True:
            self._check_requested.clear()
            if self._stopping:
                return
            self.next_check_at = math.inf  # a wait that begins from here on calls `check_now`
            now = self._clock.now()
            self.next_check_at = next_check_at = min(
                (_ended(reader, now) for reader in tuple(self._waiting)), default=math.inf
            )
            self._check_requested.wait(min(next_check_at - now, threading.TIMEOUT_MAX))


def _ended(reader: Waiter, now: float) -> float:
    """End the wait of a reader whose deadline has passed; returns the time of its next check."""
    deadline = reader.deadline
    if deadline > now:
        return deadline
    reader.wake()
    return now + WAKE_AGAIN_S
