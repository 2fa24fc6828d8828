"""What stands at a moment of a match: the newest of what is said on change alone, and where the world is.

A file that begins in the middle of a match begins with it, so that it can be read without the files before it.
"""

from collections.abc import Iterable

from schemas.bus.contract import Received
from schemas.topics import APPLIED, ORDER, STANDING_ORDER, STATE, WORLD

Logged = tuple[int, Received]
"""Log time in ns, and message."""

_NEWEST = frozenset({WORLD.key, STATE.key, ORDER.key, STANDING_ORDER.key, APPLIED.key})
"""Rows whose newest message stands until the next one on its key."""
_CHANGES = (b'"robots":[', b'"parameters":{"', b'"obstacles":[')
"""Of `host/applied`: what changed for good in that tick; all of them stand, one on the other."""


class Standing:
    """Follows the messages of a recording in their order."""

    def __init__(self) -> None:
        self._newest: dict[str, Logged] = {}
        self._changes: list[Logged] = []

    def take(self, batch: Iterable[Logged]) -> None:
        """Messages have gone by."""
        newest = self._newest
        for logged in batch:
            received = logged[1]
            row = received.topic.key
            if row not in _NEWEST:
                continue
            if row == APPLIED.key:
                before = newest.get(received.key)
                if before is not None and any(mark in before[1].payload for mark in _CHANGES):
                    self._changes.append(before)
            newest[received.key] = logged

    def messages(self, since_ns: int = 0) -> list[Logged]:
        """What stands, oldest first, with the log times it had; what is older than `since_ns` is left out."""
        every = [*self._changes, *self._newest.values()]
        return sorted((logged for logged in every if logged[0] >= since_ns), key=lambda logged: logged[0])
