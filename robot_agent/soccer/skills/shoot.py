"""Where to shoot, and whether a lane is free of opponents."""

import math
from collections.abc import Sequence

from schemas.config.sections import Pitch

PLACES = (-0.8, -0.4, 0.0, 0.4, 0.8)
"""Where in the goal to aim, as shares of half its width."""

_SHOT_CLOSES = 0.075
"""m that a keeper moves while a shot rolls a metre: 0.45 m in the 0.6 s of 6 m, at 2.5 m/s²."""
_PASS_CLOSES = 0.05
"""m that an opponent moves while a pass rolls a metre; a pass is slower, but few opponents react at once."""


def best_place(
    ball: tuple[float, float], opponents: Sequence[tuple[float, float]], pitch: Pitch
) -> tuple[float, float]:
    """The y in the opponents' goal whose lane is the widest, and that width in m, at most half the goal's."""
    half = 0.5 * pitch.goal_width
    best, widest = 0.0, -1.0
    for share in PLACES:
        target = (pitch.goal_line, share * half)
        width = min(half, lane_width(ball, target, opponents, _SHOT_CLOSES))
        width = min(width, 2.0 * half * (1.05 - abs(share)))
        if width > widest:
            best, widest = target[1], width
    return best, widest


def lane_width(
    start: tuple[float, float],
    end: tuple[float, float],
    opponents: Sequence[tuple[float, float]],
    closes: float = _PASS_CLOSES,
) -> float:
    """Distance of the nearest opponent's centre from the straight path, in m; infinite when none is beside it.

    An opponent farther along the path has more time to move into it, and counts as nearer, by `closes` m a metre.
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    if length < 1e-6:
        return math.inf
    ux, uy = dx / length, dy / length
    least = math.inf
    for x, y in opponents:
        along = (x - start[0]) * ux + (y - start[1]) * uy
        if -0.2 < along < length + 0.3:
            beside = abs((y - start[1]) * ux - (x - start[0]) * uy)
            least = min(least, beside - closes * along)
    return least
