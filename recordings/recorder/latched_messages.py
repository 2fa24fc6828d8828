"""The latched messages at a time of a match: the newest world, and the newest of each topic sent on change only.

A file that begins in the middle of a match begins with them, so that it can be read without the files before it.
"""

from collections.abc import Iterable

from recordings.container.applied_changes import changes_in
from schemas.bus.contract import ReceivedMessage
from schemas.topics import ACTIVE_ORDER, APPLIED, ORDER, STATE, WORLD

LoggedMessage = tuple[int, ReceivedMessage]
"""Log time in ns, and message."""

_LATCHED_KEYS = frozenset({WORLD.key, STATE.key, ORDER.key, ACTIVE_ORDER.key, APPLIED.key})
"""Topics whose newest message is valid until the next one on its key."""


class LatchedMessages:
    """Follows the messages of a recording in their order."""

    def __init__(self) -> None:
        self._newest: dict[str, LoggedMessage] = {}
        self._changes: list[LoggedMessage] = []
        """Messages `host/applied` with lasting changes; all of them remain valid."""

    def update(self, batch: Iterable[LoggedMessage]) -> None:
        """Add messages."""
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

    def messages(self) -> list[LoggedMessage]:
        """The latched messages with their log times, oldest first."""
        return sorted([*self._changes, *self._newest.values()], key=lambda logged: logged[0])
