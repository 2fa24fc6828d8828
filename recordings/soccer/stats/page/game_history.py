"""The history of a game for a page: phase, score and clock over time."""

from dataclasses import dataclass
from typing import Any

from recordings.soccer.stats.match_tick import MatchTick


@dataclass(frozen=True, slots=True)
class GameInterval:
    """The game state from a time on, in s of simulated time."""

    time: float
    phase: str
    side: str | None
    running: bool
    score: tuple[int, int] | None
    """Cyan's and magenta's goals."""
    cyan_attacks: int


class GameHistory:
    """Follows the ticks, and notes changes of the game state."""

    def __init__(self) -> None:
        self.intervals: list[GameInterval] = []
        self.clock: list[float] = []
        """Game clock at each whole second after the first world."""
        self._start: float | None = None
        self._last: tuple[Any, ...] = ()

    def cyan_attacks(self, time: float) -> int:
        """Sign of the x direction in which cyan attacked at a time, in s of simulated time."""
        return next((interval.cyan_attacks for interval in reversed(self.intervals) if interval.time <= time), 1)

    def update(self, match_tick: MatchTick) -> None:
        """Add a tick."""
        world, state = match_tick.world, match_tick.state
        if self._start is None:
            self._start = world.time
        while self._start + len(self.clock) <= world.time:
            self.clock.append(round(world.clock, 2))
        if state is None or state is match_tick.state_before:
            return
        current = (state.phase, state.side, state.running, state.score, state.cyan_attacks)
        if current == self._last:
            return
        self._last = current
        score = (state.score.cyan, state.score.magenta)
        side = state.side.value if state.side is not None else None
        self.intervals.append(
            GameInterval(world.time, state.phase.value, side, state.running, score, state.cyan_attacks)
        )
