"""Without a radio: each field robot plays the ball in its own part of the pitch. Pure.

All robots divide the pitch in the same way, by their numbers, so that one of them goes for the ball without a message.
"""

import math
from collections.abc import Sequence

from schemas.config.sections import Pitch
from schemas.frames import Point

MIDDLES = (
    (-0.5, 0.0),
    (0.0, 0.5),
    (0.0, -0.5),
    (0.5, 0.0),
    (-0.5, 0.6),
    (-0.5, -0.6),
    (0.5, 0.6),
    (0.5, -0.6),
    (0.0, 0.0),
    (-0.8, 0.0),
)
"""Middles of the parts, as shares of half the pitch's length and width, for the field robots in the team's order."""
STAYS = 1.0
"""m by which the ball must be nearer to the middle of another part, before the robot that plays it leaves it."""


def owner_of(ball: Point, field: Sequence[str], pitch: Pitch, plays: str | None = None) -> str:
    """The robot in whose part the ball is.

    `field`: the field robots in the team's order; `plays`: the robot that plays the ball so far.
    """
    far = {
        name: math.hypot(ball[0] - x * pitch.goal_line, ball[1] - y * pitch.touch_line)
        - (STAYS if name == plays else 0.0)
        for name, (x, y) in zip(field, MIDDLES, strict=False)
    }
    return min(far, key=lambda name: far[name])
