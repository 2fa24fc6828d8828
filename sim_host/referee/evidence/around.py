"""Where robots are in one tick: near the ball, deep before a goal, outside the lines; one pass over all of them."""

from typing import NamedTuple

from sim_host.referee.match import Match
from sim_host.snapshot import Snapshot


class Around(NamedTuple):
    """Robots by their place in the roster, in its order."""

    near: tuple[int, ...]
    """The hull is within `scrum.reach` of the ball's hull."""
    deep: tuple[int, ...]
    """Beyond the front line of a penalty area, at whatever y; without goalkeepers before their own goals."""
    outside: tuple[int, ...]
    """The whole hull is outside the lines."""


_NOBODY: tuple[int, ...] = ()


def look_around(match: Match, cyan_attacks: int, snapshot: Snapshot) -> Around:
    """One tick's places; `cyan_attacks` is the sign of the x direction that cyan attacks."""
    ball, deep_x, touch = snapshot.ball, match.deep_x, match.pitch.touch_line
    bx, by = ball[0], ball[1]
    near, deep, outside = _NOBODY, _NOBODY, _NOBODY
    for index, (robot, near_squared) in enumerate(zip(snapshot.robots, match.near_squared, strict=True)):
        x, y = robot[0], robot[1]
        dx, dy = x - bx, y - by
        if dx * dx + dy * dy < near_squared:
            near = (*near, index)
        if x > deep_x or x < -deep_x:
            if not (match.is_keeper[index] and x * match.roster.sides[index].attack(cyan_attacks) < 0):
                deep = (*deep, index)
            if _is_outside(match, index, x, y):
                outside = (*outside, index)
        elif (y > touch or y < -touch) and _is_outside(match, index, x, y):
            outside = (*outside, index)
    return Around(near, deep, outside)


def _is_outside(match: Match, index: int, x: float, y: float) -> bool:
    """Whether the whole hull is outside the lines."""
    reach = match.reaches[index]
    return abs(x) > match.pitch.goal_line + reach or abs(y) > match.pitch.touch_line + reach
