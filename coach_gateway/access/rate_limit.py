"""How many messages a page, a program or a box may send: a rate, with a burst allowed. Pure."""


class TokenBucket:
    """Fills up with time, and is drained by messages."""

    def __init__(self, per_second: float, at_once: float, now: float) -> None:
        self._per_second = per_second
        self._at_once = at_once
        self._left = at_once
        self._looked_at = now

    def has_room(self, now: float, amount: float = 1.0) -> bool:
        """Whether this amount is within the limit at this wall time in s; counts nothing."""
        self._left = min(self._at_once, self._left + (now - self._looked_at) * self._per_second)
        self._looked_at = now
        return self._left >= amount

    def allow(self, now: float) -> bool:
        """Whether one more message is allowed at this wall time in s; if so, it is counted."""
        if not self.has_room(now):
            return False
        self._left -= 1.0
        return True

    def delay(self, now: float, amount: float) -> float:
        """Count an amount in any case; returns the s of wall time after which the limit holds again."""
        self.has_room(now)
        self._left -= amount
        return max(0.0, -self._left / self._per_second)
