"""How wall time moves a replay: a pure core, (transport, wall time) → the simulated time that is due."""

import math
from dataclasses import dataclass, replace

AS_FAST_AS_POSSIBLE = math.inf
"""A rate at which everything is due at once."""


@dataclass(frozen=True, slots=True)
class PlaybackClock:
    """A replay's motion since it was last changed: where it was, when, and how fast it has moved since."""

    at_ns: int
    """Simulated time in ns."""
    since: float
    """Wall time in s at which it was there."""
    rate: float = 1.0
    """Simulated seconds per wall second."""
    paused: bool = False

    def due_ns(self, now: float) -> float:
        """Everything up to this simulated time, ns, should have been sent."""
        if self.paused or (now <= self.since and not math.isinf(self.rate)):
            return self.at_ns
        return self.rate if math.isinf(self.rate) else self.at_ns + round((now - self.since) * self.rate * 1e9)

    def wait(self, ns: int, now: float) -> float:
        """Wall time in s until this simulated time is due; for ever while it stands still."""
        if self.paused:
            return math.inf
        return 0.0 if math.isinf(self.rate) else max(0.0, (ns - self.due_ns(now)) / self.rate / 1e9)

    def moved(self, at_ns: int, now: float) -> "PlaybackClock":
        """Standing elsewhere, at the same rate."""
        return replace(self, at_ns=at_ns, since=now)

    def changed(
        self, at_ns: int, now: float, *, rate: float | None = None, paused: bool | None = None
    ) -> "PlaybackClock":
        """Going on from where it is at another rate, or standing still there."""
        return PlaybackClock(at_ns, now, self.rate if rate is None else rate, self.paused if paused is None else paused)
