"""Wall time as a process lived it: one that stood still has not waited meanwhile."""

MAX_STEP_S = 0.5
"""Wall time between two looks that counts; what is longer was not lived through."""


class ActiveClock:
    """A clock that is looked at again and again, and stands still with its process."""

    def __init__(self, now: float) -> None:
        self.elapsed = 0.0
        """Wall time lived through so far, s."""
        self._updated_at = now

    def update(self, now: float) -> bool:
        """It is `now`, in s of wall time; whether the process stood still since the last look."""
        since = now - self._updated_at
        self._updated_at = now
        self.elapsed += min(since, MAX_STEP_S)
        return since > MAX_STEP_S
