"""How long a recorder sleeps between two polls: reading the messages of many ticks together costs less.

Each poll loads the recorder's code into caches that host and robots have used since the last one.
"""

from recordings.timing import POLL_S
from schemas.recovery_window import REST_TICKS


class PollInterval:
    """Adapts the interval to the speed of the match."""

    def __init__(self, now: float) -> None:
        self._tick, self._polled_at = -1, now

    def next_poll(self, now: float, tick: int) -> float:
        """Wall time of the next poll in s, after a poll at `now` that has read up to this tick."""
        came, since = tick - self._tick, now - self._polled_at
        self._tick, self._polled_at = tick, now
        return now + (min(POLL_S, REST_TICKS * since / came) if came > 0 else POLL_S)
