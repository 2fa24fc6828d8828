"""The clocks of a match: game clock, effective playing time, and the timer of the present phase."""

from typing import NamedTuple

ROUNDING = 1e-9
"""s; sums of ticks may fall this short of a limit that is a whole number of ticks."""


class Timing(NamedTuple):
    """All times in s."""

    limit: float
    """Game clock at which this half ends."""
    clock: float = 0.0
    """Playing time of this half and the halves before it."""
    runs: bool = False
    """Whether the clock runs: from the first START of a half to its end, also in stoppages."""
    effective: float = 0.0
    """Time for which the ball has been in play."""
    timer: float = 0.0
    """Time since STOP, the signal, START, or the beginning of the break."""
    until: float | None = None
    """The limit of the timer, or None."""

    def after(self, dt: float, in_play: bool, *, limited: bool = True) -> "Timing":
        """The clocks `dt` s later; if `limited`, the game clock stops at the end of the half."""
        clock = self.clock + dt if self.runs else self.clock
        return self._replace(
            clock=min(clock, self.limit) if limited and self.runs else clock,
            effective=self.effective + dt if in_play else self.effective,
            timer=self.timer + dt,
        )

    def restart_timer(self, until: float | None, *, runs: bool | None = None) -> "Timing":
        """The clocks with the timer at 0 and the limit `until`; the clock is stopped or started if `runs` is given."""
        return self._replace(timer=0.0, until=until, runs=self.runs if runs is None else runs)

    @property
    def left(self) -> float | None:
        """Time until the timer reaches its limit, rounded to 1 ms; None without a limit."""
        return None if self.until is None else max(0.0, round(self.until - self.timer, 3))


def reached(timer: float, limit: float) -> bool:
    """Whether a timer has reached its limit, both in s."""
    return timer >= limit - ROUNDING
