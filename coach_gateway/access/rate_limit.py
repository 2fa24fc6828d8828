"""How many messages a page, a program or a box may send: a rate, with a burst allowed. Pure."""


class TokenBucket:
    """Fills up with time, and is drained by messages."""

    def __init__(self, per_second: float, at_once: float, now: float) -> None:
        self._per_second = per_second
        self._at_once = at_once
        self._left = at_once
        self._looked_at = now

    def allow(self, now: float) -> bool:
        """Whether one more message is allowed at this wall time in s; if so, it is counted."""
        self._left = min(self._at_once, self._left + (now - self._looked_at) * self._per_second)
        self._looked_at = now
        if self._left < 1.0:
            return False
        self._left -= 1.0
        return True
