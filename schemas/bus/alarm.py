"""Ends waits that have an end: one thread for all readers of a session, started with the first such wait."""

import math
import threading
from typing import Protocol

from schemas.clock import Clock

_AGAIN_S = 0.05
"""Until a reader who was poked and has not woken is poked again."""


class Waiting(Protocol):
    """A reader who may wait."""

    ends_at: float
    """When its wait has to be ended, by the clock in s; infinite when there is none, or none that ends."""

    def poke(self) -> None:
        """End its wait."""


class Alarm:
    """Sleeps until the first wait ends that somebody has begun.

    Whoever begins a wait says first when it ends, then looks when the alarm will; who ends sooner rings. Most waits are
    short and end later than the alarm looks: they cost that comparison, and no lock.
    """

    def __init__(self, clock: Clock) -> None:
        self.looks_at = math.inf
        """When all readers are looked at again, by the clock in s; infinite, too, while they are being looked at."""
        self._clock = clock
        self._waiting: list[Waiting] = []
        self._thread: threading.Thread | None = None
        self._bell = threading.Event()
        self._leaving = False

    def watch(self, reader: Waiting) -> None:
        """Look after this reader, too."""
        self._waiting.append(reader)

    def ring(self) -> None:
        """Look at all readers now: a wait has begun that ends sooner than they would be looked at."""
        self._bell.set()
        if self._thread is None:
            thread = threading.Thread(target=self._run, name="bus-alarm", daemon=True)
            thread.start()
            self._thread = thread  # only now: a signal within `start` must not leave a thread that cannot be joined

    def leave(self) -> None:
        """End the thread; waits are not ended any more."""
        self._leaving = True
        self._bell.set()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()

    def _run(self) -> None:
        while True:
            self._bell.clear()
            if self._leaving:
                return
            self.looks_at = math.inf  # who begins to wait from here on may have been overlooked, and rings
            now = self._clock.now()
            self.looks_at = looks_at = min((_ended(reader, now) for reader in tuple(self._waiting)), default=math.inf)
            self._bell.wait(min(looks_at - now, threading.TIMEOUT_MAX))


def _ended(reader: Waiting, now: float) -> float:
    """End a reader's wait whose time has come; when it has to be looked at again."""
    ends_at = reader.ends_at
    if ends_at > now:
        return ends_at
    reader.poke()
    return now + _AGAIN_S
