"""Queue of messages between the thread that delivers them and the thread that reads them.

Based on `SimpleQueue`, whose put never blocks and never depends on another thread: a slow reader cannot delay the
delivering thread, so that one slow subscription does not stall a Zenoh session.
"""

from queue import Empty, SimpleQueue
from typing import Generic, TypeVar

T = TypeVar("T")


class _End:
    """The item that wakes a reader at the end."""


_END = _End()


class Mailbox(Generic[T]):
    """Keeps every item, in order."""

    def __init__(self) -> None:
        self._queue: SimpleQueue[T | _End] = SimpleQueue()
        self.is_empty = self._queue.empty
        """Whether neither an item nor the end is waiting."""
        self.put = self._queue.put
        """Adds an item."""

    def __len__(self) -> int:
        return self._queue.qsize()

    def get(self, timeout: float | None) -> T | None:
        """The oldest item, waiting up to `timeout` s (None: without limit); None without an item, and at the end."""
        if timeout == 0.0 and self._queue.empty():
            return None  # the usual case without a timeout; an exception costs more than this test
        try:
            item = self._queue.get(timeout != 0.0, timeout)
        except Empty:
            return None
        if isinstance(item, _End):
            self.close()
            return None
        return item

    def close(self) -> None:
        """End the mailbox and wake its reader."""
        self._queue.put(_END)
