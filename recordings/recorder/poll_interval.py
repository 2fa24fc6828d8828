"""How long a recorder waits between two looks: what came in many ticks costs less than what comes in each.

A look brings a recorder's code back into caches that host and robots have used meanwhile.
"""

from schemas.recovery_window import REST_TICKS

_MAX_S = 0.2
"""Wall time of a rest when fewer come: progress is told, and the file written, at least so often."""


class PollInterval:
    """Follows how fast the match is."""

    def __init__(self, now: float) -> None:
        self._tick, self._polled_at = -1, now

    def next_poll(self, now: float, tick: int) -> float:
        """When to look again, wall time in s, after a look at `now` that found the match at this tick."""
        came, since = tick - self._tick, now - self._polled_at
        self._tick, self._polled_at = tick, now
        return now + (min(_MAX_S, REST_TICKS * since / came) if came > 0 else _MAX_S)
