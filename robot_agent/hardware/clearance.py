"""The filter for clearance: the velocity nearest to the wanted one that keeps a robot off bodies, goals and boundary.

Toward each body, each wall of a goal and each side of the floor the speed is limited to that from which the robot stops
in time. These limits are half planes of velocities; the nearest velocity within all of them is the wanted one, lies on
the edge of one, or on the corner of two. What is compared is the velocity that the robot can have two ticks later: on
its way to a wanted velocity that is within the limits it may be beyond them, and its acceleration is spent on one
change at a time.
"""

import math
from collections.abc import Iterator
from itertools import combinations
from typing import NamedTuple

from schemas.config.sections import DriveLimits, Pitch
from schemas.config.task import GameName
from schemas.frames import rotate, to_body
from schemas.messages.command import Drive
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight

_DELAY = 0.15
"""s until a demand acts, and for which a body is older than the sight."""
_AHEAD = 0.04
"""s after which a velocity is compared."""
_RETREAT = 0.3
"""m/s at most, away from what is nearer than the clearance."""
_SAME = 1e-9
"""m/s."""


class _Limit(NamedTuple):
    """Velocities v with v · n ≤ most."""

    x: float
    y: float
    most: float

    def allows(self, vx: float, vy: float) -> bool:
        """Whether a velocity is within the limit."""
        return vx * self.x + vy * self.y <= self.most + _SAME


def keep_clear(drive: Drive, sight: Sight, setup: Setup, clearance: float) -> Drive:
    """A demand whose velocity keeps the clearance in m; the same object where the wanted one does.

    `setup` is that of the robot. Bodies may come as fast as the robot: half of the gap is theirs.
    """
    me, pitch, reach = sight.self, setup.pitch, setup.robot.reach
    limits = []
    for body in sight.obstacles:
        dx, dy = body.x - me.x, body.y - me.y
        away = max(math.hypot(dx, dy), _SAME)
        gap = away - reach - body.radius - clearance
        limits.append(_Limit(dx / away, dy / away, _speed(gap / 2 if gap > 0.0 else gap, setup.drive)))
    for x, y in _goal_walls(pitch, me.x, me.y) if setup.game is GameName.SOCCER else ():
        away = max(math.hypot(x - me.x, y - me.y), _SAME)
        limits.append(_Limit((x - me.x) / away, (y - me.y) / away, _speed(away - reach - clearance, setup.drive)))
    for x, y, place, half in ((1, 0, me.x, pitch.goal_line), (0, 1, me.y, pitch.touch_line)):
        for sign in (1, -1):
            gap = half + pitch.border - sign * place - reach - clearance
            limits.append(_Limit(sign * x, sign * y, _speed(gap, setup.drive)))
    wx, wy = rotate(drive.vx, drive.vy if setup.drive.sideways else 0.0, me.heading)
    most, change = setup.drive.acceleration * _AHEAD, math.hypot(wx - me.vx, wy - me.vy)
    share = 1.0 if change <= most else most / change
    wx, wy = me.vx + share * (wx - me.vx), me.vy + share * (wy - me.vy)
    fits = min(1.0, setup.drive.max_speed / max(math.hypot(wx, wy), _SAME))
    wx, wy = fits * wx, fits * wy
    if all(limit.allows(wx, wy) for limit in limits):
        return drive
    if not setup.drive.sideways:
        ahead, _ = to_body(wx, wy, me.heading)
        return Drive(vx=_along(ahead, me.heading, limits), omega=drive.omega)
    vx, vy = to_body(*_nearest(wx, wy, limits), me.heading)
    return Drive(vx=vx, vy=vy, omega=drive.omega)


def _goal_walls(pitch: Pitch, x: float, y: float) -> Iterator[tuple[float, float]]:
    """The points nearest to (x, y) of the sides and the back of the nearer goal, posts included; m."""
    inner, outer = pitch.goal_width / 2, pitch.goal_width / 2 + pitch.post
    front, back = pitch.goal_line, pitch.goal_line + pitch.goal_depth
    sign = math.copysign(1.0, x)
    for low, high in ((inner, outer), (-outer, -inner)):
        yield sign * min(back, max(front, abs(x))), min(high, max(low, y))
    yield sign * back, min(outer, max(-outer, y))


def _speed(gap: float, drive: DriveLimits) -> float:
    """m/s from which a robot stops within a gap in m; negative within the clearance."""
    if gap <= 0.0:
        return max(-_RETREAT, 2.0 * gap)
    brakes = min(drive.acceleration, drive.deceleration)
    return math.sqrt((brakes * _DELAY) ** 2 + 2.0 * brakes * gap) - brakes * _DELAY


def _nearest(wx: float, wy: float, limits: list[_Limit]) -> tuple[float, float]:
    """The velocity within all limits that is nearest to the wanted one; rest where there is none.

    Limits of two bodies that the robot is between meet far off: it is not driven out faster than it wants to go, or
    than it retreats from both.
    """
    found, top = [], max(math.hypot(wx, wy), 2.0 * _RETREAT)
    for one in limits:
        excess = wx * one.x + wy * one.y - one.most
        found.append((wx - excess * one.x, wy - excess * one.y))
    for one, other in combinations(limits, 2):
        across = one.x * other.y - one.y * other.x
        if abs(across) > _SAME:
            x, y = one.most * other.y - other.most * one.y, one.x * other.most - other.x * one.most
            found.append((x / across, y / across))
    allowed = [one for one in found if math.hypot(*one) <= top and all(limit.allows(*one) for limit in limits)]
    return min(allowed, key=lambda place: math.hypot(place[0] - wx, place[1] - wy), default=(0.0, 0.0))


def _along(wanted: float, heading: float, limits: list[_Limit]) -> float:
    """The speed ahead within all limits that is nearest to the wanted one; 0 where there is none, as in `_nearest`."""
    low, high = -math.inf, math.inf
    for limit in limits:
        ahead = limit.x * math.cos(heading) + limit.y * math.sin(heading)
        if ahead > _SAME:
            high = min(high, limit.most / ahead)
        elif ahead < -_SAME:
            low = max(low, limit.most / ahead)
        elif limit.most < 0.0:
            return 0.0
    nearest = max(low, min(high, wanted)) if low <= high else 0.0
    return nearest if abs(nearest) <= max(abs(wanted), 2.0 * _RETREAT) else 0.0
