"""Maps wall time to the simulated time of a replay, without side effects."""

import math
from dataclasses import dataclass, replace

AS_FAST_AS_POSSIBLE = math.inf
"""Rate at which all messages are due immediately."""
_LONGEST_NS = 2.0**64
"""No file is longer: log times have 64 bits."""


@dataclass(frozen=True, slots=True)
class PlaybackClock:
    """Position, time and rate of a replay since the last change of any of them."""

    at_ns: int
    """Simulated time in ns."""
    since: float
    """Wall time in s of that position."""
    rate: float = 1.0
    """Simulated seconds per wall second."""
    paused: bool = False

    def due_ns(self, now: float) -> float:
        """Simulated time in ns up to which messages are due."""
        if self.paused or (now <= self.since and not math.isinf(self.rate)):
            return self.at_ns
        return (
            self.rate
            if math.isinf(self.rate)
            else self.at_ns + round(min((now - self.since) * self.rate * 1e9, _LONGEST_NS))
        )

    def wait(self, ns: int, now: float) -> float:
        """Wall time in s until this simulated time is due; infinite while paused."""
        if self.paused:
            return math.inf
        return 0.0 if math.isinf(self.rate) else max(0.0, (ns - self.due_ns(now)) / self.rate / 1e9)

    def moved(self, at_ns: int, now: float) -> "PlaybackClock":
        """A clock at another position, with the same rate."""
        return replace(self, at_ns=at_ns, since=now)

    def changed(
        self, at_ns: int, now: float, *, rate: float | None = None, paused: bool | None = None
    ) -> "PlaybackClock":
        """A clock at the given position, with another rate or another state of pause."""
        return PlaybackClock(at_ns, now, self.rate if rate is None else rate, self.paused if paused is None else paused)
