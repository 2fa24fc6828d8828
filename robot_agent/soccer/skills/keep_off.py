"""Keep off the ball at a set piece: the nearest place that is far enough away and on the pitch, and the way there."""

import math
from collections.abc import Sequence

from robot_agent.sdk.bodies import Moving
from robot_agent.sdk.skills.avoid import Circle, is_in_the_way
from robot_agent.sdk.skills.keep_out import Area
from schemas.config.sections import Pitch
from schemas.frames import wrap

APART = 1.2
"""m between two places."""
_STEP = math.radians(10.0)
_AHEAD = math.radians(30.0)
"""How far around the spot the next point of a way is."""


def keep_off(
    x: float,
    y: float,
    spot: tuple[float, float],
    distance: float,
    pitch: Pitch,
    inset: float,
    outside: Area | None = None,
    taken: Sequence[tuple[float, float]] = (),
) -> tuple[float, float]:
    """(x, y) moved to at least `distance` m from the spot, `inset` m inside the lines.

    A wanted place that is too near moves out along its own radius. Where that leads beyond the lines, into the areas
    `outside` or next to a place that is taken, it goes around the spot until the pitch has room. The first side that is
    tried depends on whether a place is taken, so that of two robots with the same wanted place each gets its own side.
    """
    x, y = inside(x, y, pitch, inset)
    dx, dy = x - spot[0], y - spot[1]
    away = math.hypot(dx, dy)
    if away >= distance and not _is_near(taken, (x, y)):
        return x, y
    distance = max(away, distance)
    first = math.atan2(dy, dx) if away > 1e-6 else math.atan2(-spot[1], -pitch.goal_line - spot[0])
    turn = -_STEP if taken else _STEP
    for step in range(19):
        for angle in (first + step * turn, first - step * turn):
            place = spot[0] + distance * math.cos(angle), spot[1] + distance * math.sin(angle)
            is_free = inside(*place, pitch, inset) == place and not _is_near(taken, place)
            if is_free and not (outside is not None and _is_in(outside, place, inset)):
                return place
    return x, y


def way_around(
    me: Moving,
    place: tuple[float, float],
    spot: tuple[float, float],
    distance: float,
    pitch: Pitch,
    inset: float,
    outside: Area,
) -> tuple[float, float]:
    """The next point of a way to a place that stays `distance` m away from the spot: the place if the way is straight.

    Otherwise a point farther around the spot, on the side where less of the way leads beyond the lines or into the
    areas `outside`; of two such sides, the shorter one.
    """
    if not is_in_the_way(me, *place, Circle(*spot, distance)):
        return place
    begin = math.atan2(me.y - spot[1], me.x - spot[0])
    turn = wrap(math.atan2(place[1] - spot[1], place[0] - spot[0]) - begin)

    def barred(way: float) -> int:
        """Steps of a way, rad around the spot, that lead beyond the lines or into the areas."""
        steps = [begin + math.copysign(step * _STEP, way) for step in range(1, int(abs(way) / _STEP))]
        points = [(spot[0] + distance * math.cos(angle), spot[1] + distance * math.sin(angle)) for angle in steps]
        return sum(inside(*point, pitch, inset) != point or _is_in(outside, point, inset) for point in points)

    way = min(turn, turn - math.copysign(math.tau, turn), key=lambda one: (barred(one), abs(one)))
    angle, radius = begin + math.copysign(_AHEAD, way), distance / math.cos(0.5 * _AHEAD)
    return spot[0] + radius * math.cos(angle), spot[1] + radius * math.sin(angle)


def _is_near(taken: Sequence[tuple[float, float]], place: tuple[float, float]) -> bool:
    return any(math.dist(place, other) < APART for other in taken)


def _is_in(areas: Area, place: tuple[float, float], inset: float) -> bool:
    """Whether a place is in one of the areas, or closer than `inset` m to it."""
    grown = areas._replace(depth=areas.depth + inset, width=areas.width + 2.0 * inset)
    return grown.has(math.copysign(1.0, place[0]), *place)


def inside(x: float, y: float, pitch: Pitch, inset: float) -> tuple[float, float]:
    """The nearest point that is `inset` m inside the lines."""
    far, wide = pitch.goal_line - inset, pitch.touch_line - inset
    return max(-far, min(far, x)), max(-wide, min(wide, y))
