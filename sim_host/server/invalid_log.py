"""Payloads that were no valid message: kept until they are published, a few at most, so that a flood is not echoed."""

from collections import deque

from schemas.messages.host import Invalid

_CAPACITY = 100
"""Entries that wait to be published; of a flood the newest are kept."""


class InvalidLog:
    """What was wrong with what came in, oldest first."""

    def __init__(self) -> None:
        self._entries: deque[tuple[str, str, int]] = deque(maxlen=_CAPACITY)

    def add(self, key: str, reason: str, payload: bytes) -> None:
        """A payload that was no valid message came on this key."""
        self._entries.append((key, reason, len(payload)))

    def pop(self, tick: int, time: float) -> Invalid | None:
        """The oldest entry that has not been published yet, as it is published at this tick."""
        if not self._entries:
            return None
        key, reason, size = self._entries.popleft()
        return Invalid(tick=tick, time=time, key=key, reason=reason, size=size)
