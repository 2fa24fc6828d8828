"""Wall time as a process lived it: one that stood still has not waited meanwhile."""

LONGEST_S = 0.5
"""Wall time between two looks that counts; what is longer was not lived through."""


class Awake:
    """A clock that is looked at again and again, and stands still with its process."""

    def __init__(self, now: float) -> None:
        self.passed = 0.0
        """Wall time lived through so far, s."""
        self._looked_at = now

    def look(self, now: float) -> bool:
        """It is `now`, in s of wall time; whether the process stood still since the last look."""
        since = now - self._looked_at
        self._looked_at = now
        self.passed += min(since, LONGEST_S)
        return since > LONGEST_S
