"""Payloads that were no valid message: kept until they are published, a few at most, so that a flood is not echoed."""

from collections import deque

from schemas.host import Invalid

_KEPT = 100
"""Complaints that wait to be published; of a flood the newest are kept."""


class Complaints:
    """What was wrong with what came in, oldest first."""

    def __init__(self) -> None:
        self._waiting: deque[tuple[str, str, int]] = deque(maxlen=_KEPT)

    def note(self, key: str, reason: str, payload: bytes) -> None:
        """A payload that was no valid message came on this key."""
        self._waiting.append((key, reason, len(payload)))

    def take(self, tick: int, time: float) -> Invalid | None:
        """The oldest complaint that has not been published yet, as it is published at this tick."""
        if not self._waiting:
            return None
        key, reason, size = self._waiting.popleft()
        return Invalid(tick=tick, time=time, key=key, reason=reason, size=size)
