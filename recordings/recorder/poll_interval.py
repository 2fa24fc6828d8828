"""How long a recorder sleeps between two polls: reading the messages of many ticks together costs less.

Each poll loads the recorder's code into caches that host and robots have used since the last one.
"""

from schemas.recovery_window import REST_TICKS

_MAX_S = 0.2
"""Longest wall time between two polls: progress is reported and the file written at least this often."""


class PollInterval:
    """Adapts the interval to the speed of the match."""

    def __init__(self, now: float) -> None:
        self._tick, self._polled_at = -1, now

    def next_poll(self, now: float, tick: int) -> float:
        """Wall time of the next poll in s, after a poll at `now` that has read up to this tick."""
        came, since = tick - self._tick, now - self._polled_at
        self._tick, self._polled_at = tick, now
        return now + (min(_MAX_S, REST_TICKS * since / came) if came > 0 else _MAX_S)
