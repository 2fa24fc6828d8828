"""Ends waits that have an end: one thread for all readers of a session, started with the first such wait."""

import threading
from typing import Protocol

from schemas.clock import Clock

_RESOLUTION_S = 0.05
"""Resolution of timeouts."""


class Waiting(Protocol):
    """A reader who may wait."""

    def poke_if_due(self, now: float) -> None:
        """End its wait, if that has lasted long enough at this time of the clock."""


class Alarm:
    """Looks after everybody who waits."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._waiting: list[Waiting] = []
        self._thread: threading.Thread | None = None
        self._leaving = threading.Event()

    def watch(self, reader: Waiting) -> None:
        """Look after this reader, too."""
        self._waiting.append(reader)

    def wake(self) -> None:
        """Make sure that waits which have an end are ended."""
        if self._thread is None:
            thread = threading.Thread(target=self._ring, name="bus-alarm", daemon=True)
            thread.start()
            self._thread = thread  # only now: a signal within `start` must not leave a thread that cannot be joined

    def leave(self) -> None:
        """End the thread; waits are not ended any more."""
        self._leaving.set()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()

    def _ring(self) -> None:
        while not self._leaving.wait(_RESOLUTION_S):
            now = self._clock.now()
            for reader in tuple(self._waiting):
                reader.poke_if_due(now)
