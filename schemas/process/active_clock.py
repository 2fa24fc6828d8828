"""Wall time as a process lived it: one that was suspended has not waited meanwhile."""

LONGEST_S = 0.5
"""Wall time between two looks that counts; what is longer was not lived through."""


class ActiveClock:
    """A clock that is looked at again and again, and stands still while its process does."""

    def __init__(self, now: float) -> None:
        self.passed = 0.0
        """Wall time lived through so far, s."""
        self._looked_at = now

    def look(self, now: float) -> float:
        """It is `now`, in s of wall time; returns the wall time lived through so far, s."""
        self.passed += min(now - self._looked_at, LONGEST_S)
        self._looked_at = now
        return self.passed
