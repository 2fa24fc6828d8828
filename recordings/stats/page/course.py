"""The course of a game for a page: what was being played, the score and the clock, where they changed."""

from dataclasses import dataclass
from typing import Any

from recordings.stats.moment import Moment


@dataclass(frozen=True, slots=True)
class Leg:
    """What holds from a time on, s of simulated time."""

    time: float
    phase: str
    side: str | None
    running: bool
    score: tuple[int, int] | None
    """Cyan's and magenta's goals."""
    cyan_attacks: int


class Course:
    """Takes in moments, and keeps those at which something changed."""

    def __init__(self) -> None:
        self.legs: list[Leg] = []
        self.clock: list[float] = []
        """Game clock at each whole second after the first world."""
        self._start: float | None = None
        self._said: tuple[Any, ...] = ()

    def cyan_attacks(self, time: float) -> int:
        """Sign of the x direction that cyan attacked at a time, s of simulated time."""
        return next((leg.cyan_attacks for leg in reversed(self.legs) if leg.time <= time), 1)

    def take(self, moment: Moment) -> None:
        """One more tick."""
        world, state = moment.world, moment.state
        if self._start is None:
            self._start = world.time
        while self._start + len(self.clock) <= world.time:
            self.clock.append(round(world.clock, 2))
        if state is None or state is moment.state_before:
            return
        said = (state.phase, state.side, state.running, state.score, state.cyan_attacks)
        if said == self._said:
            return
        self._said = said
        score = (state.score.cyan, state.score.magenta)
        side = state.side.value if state.side is not None else None
        self.legs.append(Leg(world.time, state.phase.value, side, state.running, score, state.cyan_attacks))
