"""What stands at a moment of a match: the newest of what is said on change alone, and where the world is.

A file that begins in the middle of a match begins with it, so that it can be read without the files before it.
"""

from collections.abc import Iterable

from recordings.container.applied_changes import changes_in
from schemas.bus.contract import ReceivedMessage
from schemas.topics import ACTIVE_ORDER, APPLIED, ORDER, STATE, WORLD

LoggedMessage = tuple[int, ReceivedMessage]
"""Log time in ns, and message."""

_LATCHED_KEYS = frozenset({WORLD.key, STATE.key, ORDER.key, ACTIVE_ORDER.key, APPLIED.key})
"""Rows whose newest message stands until the next one on its key."""


class LatchedMessages:
    """Follows the messages of a recording in their order."""

    def __init__(self) -> None:
        self._newest: dict[str, LoggedMessage] = {}
        self._changes: list[LoggedMessage] = []
        """Of `host/applied`: what changed for good; all of them stand, one on the other."""

    def update(self, batch: Iterable[LoggedMessage]) -> None:
        """Messages have gone by."""
        newest = self._newest
        for logged in batch:
            received = logged[1]
            row = received.topic.key
            if row not in _LATCHED_KEYS:
                continue
            if row == APPLIED.key:
                before = newest.get(received.key)
                if before is not None and changes_in(before[1].payload):
                    self._changes.append(before)
            newest[received.key] = logged

    def messages(self, since_ns: int = 0) -> list[LoggedMessage]:
        """What stands, oldest first, with the log times it had; what is older than `since_ns` is left out."""
        every = [*self._changes, *self._newest.values()]
        return sorted((logged for logged in every if logged[0] >= since_ns), key=lambda logged: logged[0])
