"""A clock with which tests need no wall time."""

from runtime.process.clock import UNKNOWN_SIM_NS


class SteppedClock:
    """Wall time that passes only in `sleep_until`: a paced loop takes no time and is deterministic."""

    __slots__ = ("_now", "sim_ns")

    def __init__(self) -> None:
        self.sim_ns = UNKNOWN_SIM_NS
        self._now = 0.0

    def now(self) -> float:
        """The sum of all sleeps so far, in s."""
        return self._now

    def unix_ns(self) -> int:
        """The sum of all sleeps so far, in ns."""
        return round(self._now * 1e9)

    def sleep_until(self, moment: float) -> None:
        """Advance to `moment` at once."""
        self._now = max(self._now, moment)
