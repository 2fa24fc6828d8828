"""How long a recorder rests between two looks: what came in many ticks costs less than what comes in each.

A look brings a recorder's code back into caches that host and robots have used meanwhile.
"""

_TICKS = 60
"""Ticks that may come meanwhile; a lockstep host waits for a recorder that is four times as many behind."""
_LONGEST_S = 0.2
"""Wall time of a rest when fewer come: progress is told, and the file written, at least so often."""


class Rest:
    """Follows how fast the match is."""

    def __init__(self, now: float) -> None:
        self._tick, self._looked_at = -1, now

    def until(self, now: float, tick: int) -> float:
        """When to look again, wall time in s, after a look at `now` that found the match at this tick."""
        came, since = tick - self._tick, now - self._looked_at
        self._tick, self._looked_at = tick, now
        return now + (min(_LONGEST_S, _TICKS * since / came) if came > 0 else _LONGEST_S)
