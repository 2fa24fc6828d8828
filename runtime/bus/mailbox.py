"""Queues of messages between the thread that delivers them and the thread that reads them.

Based on `SimpleQueue`, whose put never blocks and never depends on another thread: a slow reader cannot delay the
delivering thread, so that one slow subscription does not stall a Zenoh session.
"""

from queue import Empty, SimpleQueue
from typing import Generic, TypeVar

T = TypeVar("T")


class _End:
    """The item that wakes a reader at the end."""


_END = _End()


class FifoMailbox(Generic[T]):
    """Keeps every item, in order."""

    def __init__(self) -> None:
        self._queue: SimpleQueue[T | _End] = SimpleQueue()
        self.is_empty = self._queue.empty
        """Whether neither an item nor the end is waiting."""

    def __len__(self) -> int:
        return self._queue.qsize()

    def put(self, key: str, item: T) -> None:
        """Add an item; the key has no effect."""
        del key
        self._queue.put(item)

    def get(self, timeout: float | None) -> T | None:
        """The oldest item, waiting up to `timeout` s (None: without limit); None without an item, and at the end."""
        item = _get_from(self._queue, timeout)
        if isinstance(item, _End):
            self._queue.put(item)
            return None
        return item

    def close(self) -> None:
        """End the mailbox and wake its reader."""
        self._queue.put(_END)


class NewestMailbox(Generic[T]):
    """Keeps the newest item of each key."""

    def __init__(self) -> None:
        self._newest: dict[str, T] = {}
        self._keys: SimpleQueue[str | _End] = SimpleQueue()

    def put(self, key: str, item: T) -> None:
        """Add an item; it replaces an unread older item of the same key."""
        self._newest[key] = item
        self._keys.put(key)

    def get(self, timeout: float | None) -> T | None:
        """The newest item of the key that has waited longest; otherwise as `FifoMailbox.get`."""
        while True:
            key = _get_from(self._keys, timeout)
            if key is None:
                return None
            if isinstance(key, _End):
                self._keys.put(key)
                return None
            item = self._newest.pop(key, None)  # replaced, and returned with an earlier key
            if item is not None:
                return item

    def close(self) -> None:
        """End the mailbox and wake its reader."""
        self._keys.put(_END)


def _get_from(queue: SimpleQueue[T], timeout: float | None) -> T | None:
    if timeout == 0.0 and queue.empty():
        return None  # the usual case without a timeout; an exception costs more than this test
    try:
        return queue.get(timeout != 0.0, timeout)
    except Empty:
        return None
