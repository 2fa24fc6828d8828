"""The clocks: the only door to wall time, and a stepped one that makes tests and lockstep need none.

A clock tells two things: wall time, in which people and networks live, and simulated time, in which the match
lives. Whoever owns a bus moves its clock's simulated time; the bus stamps what it sends with both.
"""

import time
from typing import Protocol

UNKNOWN_SIM_NS = -1
"""Simulated time of a sender that has not heard any yet."""


class Clock(Protocol):
    """What the rest of the code may know of time."""

    sim_ns: int
    """Simulated time in ns, or `UNKNOWN_SIM_NS`; set by the clock's owner."""

    def now(self) -> float:
        """Monotonic wall time in s, from an arbitrary origin."""

    def unix_ns(self) -> int:
        """Wall time in ns since 1970, UTC."""

    def sleep_until(self, moment: float) -> None:
        """Return when `now()` has reached `moment`."""


class WallClock:
    """Real time."""

    __slots__ = ("sim_ns",)

    now = staticmethod(time.perf_counter)
    """Monotonic wall time in s."""
    unix_ns = staticmethod(time.time_ns)
    """Wall time in ns since 1970, UTC."""

    def __init__(self) -> None:
        self.sim_ns = UNKNOWN_SIM_NS

    def sleep_until(self, moment: float) -> None:
        """Sleep until `now()` has reached `moment`."""
        left = moment - time.perf_counter()
        if left > 0:
            time.sleep(left)


class SteppedClock:
    """Wall time that passes only when somebody sleeps: a paced loop runs in no time, and always the same."""

    __slots__ = ("_now", "sim_ns")

    def __init__(self) -> None:
        self.sim_ns = UNKNOWN_SIM_NS
        self._now = 0.0

    def now(self) -> float:
        """The time slept so far, in s."""
        return self._now

    def unix_ns(self) -> int:
        """The time slept so far, in ns."""
        return round(self._now * 1e9)

    def sleep_until(self, moment: float) -> None:
        """Let time pass to `moment` at once."""
        self._now = max(self._now, moment)
