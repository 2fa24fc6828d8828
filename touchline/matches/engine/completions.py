"""Waits for one of many futures, and for an interrupt, which does not leave a future locked."""

from concurrent.futures import Future
from queue import Empty, SimpleQueue
from typing import Any

from touchline.launch.processes.stop_signals import StopSignals
from touchline.timing import POLL_S


class Completions:
    """Futures in the order in which they end.

    Raised at once, an interrupt can fall between the acquisition of a future's lock and its release: whoever ends that
    future later then waits for ever. So signals are stored, and raised where no lock is held.
    """

    def __init__(self, stop: StopSignals) -> None:
        self._stop = stop
        self._ended: SimpleQueue[Future[Any]] = SimpleQueue()

    def add(self, future: "Future[Any]") -> None:
        """Wait for this future, too."""
        future.add_done_callback(self._ended.put)

    def next(self) -> "Future[Any]":
        """Wait for the next future that ends.

        Raises:
            KeyboardInterrupt: SIGINT or SIGTERM has come.
        """
        while self._stop.received is None:
            try:
                return self._ended.get(timeout=POLL_S)
            except Empty:
                continue
        raise KeyboardInterrupt
