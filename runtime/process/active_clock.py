"""Wall time without the times in which the process was suspended."""

from runtime.process.timing import SUSPENDED_S


class ActiveClock:
    """A clock that is read repeatedly, and stands still while its process is suspended."""

    def __init__(self, now: float) -> None:
        self.passed = 0.0
        """Active wall time so far, in s."""
        self._looked_at = now

    def look(self, now: float) -> float:
        """Advance to `now`, wall time in s; returns the active wall time so far, in s."""
        self.passed += min(now - self._looked_at, SUSPENDED_S)
        self._looked_at = now
        return self.passed
