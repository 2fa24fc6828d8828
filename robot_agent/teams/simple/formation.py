"""The places of robots that do not play the ball, relative to it."""

import math
from collections.abc import Sequence
from itertools import product

from robot_agent.sdk.skills.keep_out import Area
from robot_agent.soccer.skills.keep_off import APART, inside, keep_off
from robot_agent.teams.simple.roles import Role
from schemas.config.sections import Pitch
from schemas.frames import Point

CLEAR = 2.4
"""m between a robot and a ball that a teammate plays."""
WING = 0.25
"""Share of the pitch's width between its middle and a supporter."""
AHEAD = 2.0
"""m that supporters are ahead of the ball."""
GUARD = 0.45
"""Where the defender stands between the own goal and the ball, as a share."""
FARTHEST = 0.32
"""Distance of the defender from its goal at most, as a share of the pitch's length."""
BACK = 4.0
"""m that the backs are behind the ball."""
HALF_WING = 0.16
"""Share of the pitch's width between its middle and a back."""
BEFORE = 2.5
"""m between the defender and the centre before it."""
FAR_AHEAD = 5.0
"""m that wings and forward are ahead of the ball."""
FAR_WING = 0.4
"""Share of the pitch's width between its middle and a wing."""
_FAR_APART = frozenset({Role.DEFENDER, Role.LEFT, Role.RIGHT})
"""Roles whose places are apart by themselves."""
_STEP = 0.6
"""m between the places that are tried beside one that is taken."""
_STEPS = range(-4, 5)
"""Steps along and across."""


def places(ball: Point, pitch: Pitch, inset: float, count: int) -> list[tuple[Role, Point]]:
    """The first `count` places of the formation, the most important first; all outside the penalty areas."""
    front, areas = pitch.goal_line - pitch.penalty_area_depth - inset, Area.penalty(pitch)
    guard = _guard(ball, pitch, front)
    wing, far_wing, half_wing = WING * pitch.width, FAR_WING * pitch.width, HALF_WING * pitch.width
    ahead, far_ahead, back = ball[0] + AHEAD, ball[0] + FAR_AHEAD, ball[0] - BACK
    wanted = (
        (Role.DEFENDER, guard),
        (Role.LEFT, (ahead, wing)),
        (Role.RIGHT, (ahead, -wing)),
        (Role.LEFT_BACK, (back, half_wing)),
        (Role.RIGHT_BACK, (back, -half_wing)),
        (Role.CENTRE, (guard[0] + BEFORE, 0.0)),
        (Role.LEFT_WING, (far_ahead, far_wing)),
        (Role.RIGHT_WING, (far_ahead, -far_wing)),
        (Role.FORWARD, (far_ahead, 0.0)),
    )
    found: list[tuple[Role, Point]] = []
    for role, (x, y) in wanted[:count]:
        place = keep_off(max(-front, min(front, x)), y, ball, CLEAR, pitch, inset, areas)
        if role not in _FAR_APART:
            place = _apart(place, [taken for _, taken in found], ball, pitch, inset, front)
        found.append((role, place))
    return found


def _apart(place: Point, taken: Sequence[Point], ball: Point, pitch: Pitch, inset: float, front: float) -> Point:
    """The nearest place that is `APART` from those taken and `CLEAR` of the ball; the place itself without any."""
    if all(math.dist(place, other) >= APART for other in taken):
        return place
    near = [(place[0] + _STEP * along, place[1] + _STEP * across) for along, across in product(_STEPS, _STEPS)]
    free = [
        spot
        for spot in near
        if inside(*spot, pitch, inset) == spot
        and abs(spot[0]) <= front
        and math.dist(spot, ball) >= CLEAR
        and all(math.dist(spot, other) >= APART for other in taken)
    ]
    return min(free, key=lambda spot: math.dist(spot, place), default=place)


def _guard(ball: Point, pitch: Pitch, front: float) -> Point:
    """The defender's place between the own goal and the ball."""
    dx, dy = ball[0] + pitch.goal_line, ball[1]
    share = min(GUARD, FARTHEST * pitch.length / max(math.hypot(dx, dy), 1e-6))
    x, y = inside(share * dx - pitch.goal_line, share * dy, pitch, 0.0)
    return max(-front, x), y
