"""The messages of a match that stay valid: the newest world, and the newest of each topic sent on change only.

A file that begins in the middle of a match begins with them, so that it can be read without the files before it.
"""

from recordings.container.applied_changes import changes_in
from recordings.recorder.recording_writer import LoggedMessage
from schemas.topics import ACTIVE_ORDER, APPLIED, ORDER, STATE, WORLD

LATCHED = frozenset({WORLD.key, STATE.key, ORDER.key, ACTIVE_ORDER.key, APPLIED.key})
"""Keys of the topics whose newest message is valid until the next one on its key."""


class LatchedMessages:
    """The latched messages at a time."""

    def __init__(self) -> None:
        self._newest: dict[str, LoggedMessage] = {}
        self._changes: list[LoggedMessage] = []
        """Messages `host/applied` with lasting changes; all of them remain valid."""

    def update(self, logged: LoggedMessage) -> None:
        """Add a message of a latched topic."""
        key = logged[1].key
        before = self._newest.get(key)
        if key == APPLIED.key and before is not None and changes_in(before[1].payload):
            self._changes.append(before)
        self._newest[key] = logged

    def messages(self) -> list[LoggedMessage]:
        """The latched messages with their log times, oldest first."""
        return sorted([*self._changes, *self._newest.values()], key=lambda logged: logged[0])
