"""What a bus refused before any reader received it: messages on keys that no topic has, tokens without a name."""

import threading
from typing import NamedTuple

NO_KEY = "its key is no key of a topic"
"""Why a message on a key with wildcards, or on one that no topic has, is refused."""
_MAX_KEY = 60
"""Most characters of a key that are kept for display."""
_MAX_KEYS = 20
"""Keys that are counted separately; a flood of invented keys must not fill the memory."""


class Refusal(NamedTuple):
    """Messages of one key that were refused for one reason."""

    key: str
    reason: str
    messages: int
    size: int
    """Bytes of all these messages."""


class Refusals:
    """Counts refused messages by key and reason, for any thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._counts: dict[tuple[str, str], tuple[int, int]] = {}

    def add(self, key: str, reason: str, size: int = 0) -> None:
        """Count a message on this key of `size` bytes."""
        entry = (key[:_MAX_KEY], reason)
        with self._lock:
            if entry not in self._counts and len(self._counts) >= _MAX_KEYS:
                entry = ("others", reason)
            count, sizes = self._counts.get(entry, (0, 0))
            self._counts[entry] = count + 1, sizes + size

    def pop(self) -> list[Refusal]:
        """The counts since the last call."""
        if not self._counts:
            return []
        with self._lock:
            counts, self._counts = self._counts, {}
        return [Refusal(key, reason, count, size) for (key, reason), (count, size) in counts.items()]
