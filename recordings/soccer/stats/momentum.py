"""Momentum: which side dominates the game, over time."""

from collections.abc import Sequence
from dataclasses import dataclass

from recordings.soccer.stats.match_tick import MatchTick
from schemas.side import Side

MIN_WIDTH_S = 5.0
"""s; shorter intervals do not show which side dominates. Chosen here."""
BINS = 240
"""Number of points that a curve on a page shows. Chosen here."""


@dataclass(slots=True)
class _Bin:
    in_play: float = 0.0
    control: float = 0.0
    """Time of cyan's control minus time of magenta's, in s."""
    territory: float = 0.0
    """Time in s, weighted with the ball's position from −1, cyan's goal line, to 1, magenta's."""


class Momentum:
    """Momentum of a match: half of it possession, half of it the position of the ball."""

    def __init__(self, start: float, end: float, half_length: float) -> None:
        """`start` and `end` in s of simulated time; `half_length` in m from the centre to a goal line."""
        self.start = start
        self.width = max(MIN_WIDTH_S, (end - start) / BINS)
        """Width of one value in s."""
        self._half_length = half_length
        self._bins: list[_Bin] = []

    def update(self, match_tick: MatchTick, control: Side | None) -> None:
        """Add a tick in which the side `control`, or None, was in control."""
        if not match_tick.in_play:
            return
        number = max(0, int((match_tick.world.time - self.start) / self.width))
        while len(self._bins) <= number:
            self._bins.append(_Bin())
        now, dt = self._bins[number], match_tick.dt
        now.in_play += dt
        if control is not None:
            now.control += dt if control is Side.CYAN else -dt
        share = match_tick.attack(Side.CYAN) * match_tick.world.match_ball.x / self._half_length
        now.territory += dt * min(1.0, max(-1.0, share))

    def values(self) -> list[float]:
        """Values from −1, all magenta's, to 1, all cyan's, smoothed; 0 while the ball is not in play."""
        return _smoothed([(one.control + one.territory) / 2 for one in self._bins], [one.in_play for one in self._bins])


def _smoothed(sums: Sequence[float], weights: Sequence[float]) -> list[float]:
    """Weighted means of each value and its neighbours, which count half."""
    values = []
    for number in range(len(sums)):
        near = [(place, 1.0 if place == number else 0.5) for place in (number - 1, number, number + 1)]
        kept = [(place, share) for place, share in near if 0 <= place < len(sums)]
        weight = sum(share * weights[place] for place, share in kept)
        values.append(sum(share * sums[place] for place, share in kept) / weight if weight > 0 else 0.0)
    return values
