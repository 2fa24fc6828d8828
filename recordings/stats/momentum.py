"""Momentum: which side has more of the game, over time."""

from collections.abc import Sequence
from dataclasses import dataclass

from recordings.stats.match_tick import MatchTick
from schemas.side import Side

MIN_WIDTH_S = 5.0
"""s; ours: what is shorter says nothing about who has more of the game."""
BINS = 240
"""Ours: as many points as a curve on a page shows."""


@dataclass(slots=True)
class _Bin:
    in_play: float = 0.0
    control: float = 0.0
    """s of cyan's control less those of magenta's."""
    territory: float = 0.0
    """s · share of the way from the centre to the goal that cyan attacks; negative in cyan's half."""


class Momentum:
    """Curve of a match: half of it possession, half of it where the ball is."""

    def __init__(self, start: float, end: float, half_length: float) -> None:
        """From `start` to `end`, s of simulated time; `half_length` in m from the centre to a goal line."""
        self.start = start
        self.width = max(MIN_WIDTH_S, (end - start) / BINS)
        """s of one value."""
        self._half_length = half_length
        self._bins: list[_Bin] = []

    def update(self, match_tick: MatchTick, control: Side | None) -> None:
        """One more tick, in which that side was in control."""
        if not match_tick.in_play:
            return
        number = max(0, int((match_tick.world.time - self.start) / self.width))
        while len(self._bins) <= number:
            self._bins.append(_Bin())
        now, dt = self._bins[number], match_tick.dt
        now.in_play += dt
        if control is not None:
            now.control += dt if control is Side.CYAN else -dt
        share = match_tick.attack(Side.CYAN) * match_tick.world.ball.x / self._half_length
        now.territory += dt * min(1.0, max(-1.0, share))

    def values(self) -> list[float]:
        """From −1, all magenta's, to 1, all cyan's; smoothed over its neighbours, 0 while the ball is not in play."""
        return _smoothed([(one.control + one.territory) / 2 for one in self._bins], [one.in_play for one in self._bins])


def _smoothed(sums: Sequence[float], weights: Sequence[float]) -> list[float]:
    """Weighted means over each value and its neighbours, which count half."""
    values = []
    for number in range(len(sums)):
        near = [(place, 1.0 if place == number else 0.5) for place in (number - 1, number, number + 1)]
        kept = [(place, share) for place, share in near if 0 <= place < len(sums)]
        weight = sum(share * weights[place] for place, share in kept)
        values.append(sum(share * sums[place] for place, share in kept) / weight if weight > 0 else 0.0)
    return values
