"""A bounded queue of invalid payloads to be reported: a flood of them is not echoed on the bus."""

from collections import deque

from schemas.messages.health import Invalid

_CAPACITY = 100
"""Entries that wait to be published; the oldest are dropped first."""


class InvalidLog:
    """Reasons why received payloads were invalid, oldest first."""

    def __init__(self) -> None:
        self._entries: deque[tuple[str, str, int]] = deque(maxlen=_CAPACITY)

    def add(self, key: str, reason: str, payload: bytes) -> None:
        """Add an invalid payload that was received on this key."""
        self._entries.append((key, reason, len(payload)))

    def pop(self, tick: int, time: float) -> Invalid | None:
        """Remove the oldest entry; the message that reports it at this tick, or None if there is no entry."""
        if not self._entries:
            return None
        key, reason, size = self._entries.popleft()
        return Invalid(tick=tick, time=time, key=key, reason=reason, size=size)
