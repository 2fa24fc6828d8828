"""Zones of the robots in one tick, found in one pass: near the ball, deep before a goal, outside the lines."""

from typing import NamedTuple

from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.match_constants import MatchConstants


class Zones(NamedTuple):
    """Robots by their indices in the roster, in its order."""

    near: tuple[int, ...]
    """The hull is within `scrum.reach` of the ball's hull."""
    deep: tuple[int, ...]
    """Beyond the front line of a penalty area, at any y; without a goalkeeper before its own goal."""
    outside: tuple[int, ...]
    """The whole hull is outside the lines."""


_NO_ROBOTS: tuple[int, ...] = ()


def find_zones(match: MatchConstants, is_keeper: tuple[bool, ...], cyan_attacks: int, snapshot: Snapshot) -> Zones:
    """The zones of one tick; `is_keeper` is per robot, `cyan_attacks` the sign of the x direction that cyan attacks."""
    bx, by = snapshot.ball[0], snapshot.ball[1]
    near_squared, low, high = match.near_squared, bx - match.widest_near, bx + match.widest_near
    deep_x, touch = match.deep_x, match.pitch.touch_line
    near, deep, outside = _NO_ROBOTS, _NO_ROBOTS, _NO_ROBOTS
    for index, robot in enumerate(snapshot.robots):
        x, y = robot[0], robot[1]
        if low < x < high and (x - bx) * (x - bx) + (y - by) * (y - by) < near_squared[index]:
            near = (*near, index)
        if -deep_x <= x <= deep_x and -touch <= y <= touch:
            continue
        is_deep = not -deep_x <= x <= deep_x
        if is_deep and not (is_keeper[index] and x * match.roster.sides[index].attack(cyan_attacks) < 0):
            deep = (*deep, index)
        if is_outside(match, index, x, y):
            outside = (*outside, index)
    return Zones(near, deep, outside)


def is_outside(match: MatchConstants, index: int, x: float, y: float) -> bool:
    """Whether the whole hull of a robot with its centre at `x`, `y` is outside the lines."""
    reach = match.reaches[index]
    return abs(x) > match.pitch.goal_line + reach or abs(y) > match.pitch.touch_line + reach
