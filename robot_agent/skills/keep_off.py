"""Keep off the ball at a set piece: the nearest place to the wanted one that is far enough away and on the pitch."""

import math

from schemas.config.sections import Pitch

_STEP = math.radians(10.0)


def keep_off(
    x: float, y: float, spot: tuple[float, float], distance: float, pitch: Pitch, inset: float
) -> tuple[float, float]:
    """(x, y) moved to at least `distance` m from the spot, `inset` m inside the lines.

    A wanted place that is too near moves out along its own radius; where that leaves the pitch, it goes around the
    spot until the pitch has room.
    """
    x, y = inside(x, y, pitch, inset)
    dx, dy = x - spot[0], y - spot[1]
    if math.hypot(dx, dy) >= distance:
        return x, y
    first = math.atan2(dy, dx) if math.hypot(dx, dy) > 1e-6 else math.atan2(-spot[1], -pitch.goal_line - spot[0])
    for step in range(19):
        for turn in (step * _STEP, -step * _STEP):
            angle = first + turn
            place = spot[0] + distance * math.cos(angle), spot[1] + distance * math.sin(angle)
            if inside(*place, pitch, inset) == place:
                return place
    return x, y


def inside(x: float, y: float, pitch: Pitch, inset: float) -> tuple[float, float]:
    """The nearest point that is `inset` m inside the lines."""
    far, wide = pitch.goal_line - inset, pitch.touch_line - inset
    return max(-far, min(far, x)), max(-wide, min(wide, y))
