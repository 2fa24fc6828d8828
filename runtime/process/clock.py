"""Clocks: the only access to wall time.

A clock has wall time, the time of people and networks, and simulated time, the time of the match. The owner of a bus
advances its clock's simulated time; the bus stamps each message with both.
"""

import time
from typing import Protocol

UNKNOWN_SIM_NS = -1
"""Simulated time of a sender that has received none yet."""


class Clock(Protocol):
    """The interface of a clock."""

    sim_ns: int
    """Simulated time in ns, or `UNKNOWN_SIM_NS`; set by the owner of the clock."""

    def now(self) -> float:
        """Monotonic wall time in s, from an arbitrary origin."""

    def unix_ns(self) -> int:
        """Wall time in ns since 1970, UTC."""

    def sleep_until(self, moment: float) -> None:
        """Wait until `now()` reaches `moment`."""


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
        """Sleep until `now()` reaches `moment`."""
        left = moment - time.perf_counter()
        if left > 0:
            time.sleep(left)
