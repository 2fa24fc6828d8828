"""Where messages wait between the thread that brings them and the one that reads them.

Built on `SimpleQueue`, whose put never blocks and never needs another thread to run: a bringing thread is never
held up by a slow reader, which is what keeps one slow subscription from stalling a whole Zenoh session.
"""

from queue import Empty, SimpleQueue
from typing import Generic, Protocol, TypeVar

T = TypeVar("T")


class Mailbox(Protocol[T]):
    """Both kinds of mailbox."""

    def put(self, key: str, item: T) -> None:
        """Bring an item."""

    def get(self, timeout: float | None) -> T | None:
        """The next item, waiting up to `timeout` s (None: for ever); nothing when there is none, or at the end."""

    def close(self) -> None:
        """Wake the reader: no more items will come."""


class _End:
    """What wakes a reader at the end."""


_END = _End()


class EveryMailbox(Generic[T]):
    """Keeps every item, in order."""

    def __init__(self) -> None:
        self._queue: SimpleQueue[T | _End] = SimpleQueue()
        self.is_empty = self._queue.empty
        """Whether nothing waits, neither an item nor the end."""

    def put(self, key: str, item: T) -> None:
        """Bring an item; the key does not matter here."""
        del key
        self._queue.put(item)

    def get(self, timeout: float | None) -> T | None:
        """The oldest item."""
        item = _get_from(self._queue, timeout)
        if isinstance(item, _End):
            self._queue.put(item)
            return None
        return item

    def close(self) -> None:
        """No more items will come."""
        self._queue.put(_END)


class NewestMailbox(Generic[T]):
    """Keeps the newest item of each key."""

    def __init__(self) -> None:
        self._newest: dict[str, T] = {}
        self._keys: SimpleQueue[str | _End] = SimpleQueue()

    def put(self, key: str, item: T) -> None:
        """Bring an item; an older one of the same key that nobody took is forgotten."""
        self._newest[key] = item
        self._keys.put(key)

    def get(self, timeout: float | None) -> T | None:
        """The newest item of the key that has waited longest."""
        while True:
            key = _get_from(self._keys, timeout)
            if key is None:
                return None
            if isinstance(key, _End):
                self._keys.put(key)
                return None
            item = self._newest.pop(key, None)  # the item was replaced, and taken with an earlier key
            if item is not None:
                return item

    def close(self) -> None:
        """No more items will come."""
        self._keys.put(_END)


def _get_from(queue: SimpleQueue[T], timeout: float | None) -> T | None:
    if timeout == 0.0 and queue.empty():
        return None  # mostly so where somebody only looks; an exception costs more than the look
    try:
        return queue.get(timeout != 0.0, timeout)
    except Empty:
        return None
