"""Where robots are in one tick: near the ball, deep before a goal, outside the lines; one pass over all of them."""

from typing import NamedTuple

from sim_host.referee.match import Match
from sim_host.snapshot import Snapshot


class Around(NamedTuple):
    """Robots by their place in the roster, in its order."""

    near: tuple[int, ...]
    """The hull is within `scrum.reach` of the ball's hull."""
    deep: tuple[int, ...]
    """Beyond the front line of a penalty area, at whatever y."""
    outside: tuple[int, ...]
    """The whole hull is outside the lines."""


_NOBODY: tuple[int, ...] = ()


def look_around(match: Match, snapshot: Snapshot) -> Around:
    """One tick's places."""
    ball, deep_x = snapshot.ball, match.deep_x
    line, touch = match.pitch.goal_line, match.pitch.touch_line
    bx, by = ball.x, ball.y
    near, deep, outside = _NOBODY, _NOBODY, _NOBODY
    for index, robot in enumerate(snapshot.robots):
        x, y = robot[0], robot[1]
        if (x - bx) * (x - bx) + (y - by) * (y - by) < match.near_squared[index]:
            near = (*near, index)
        if x > deep_x or x < -deep_x:
            deep = (*deep, index)
            if abs(x) > line + match.reaches[index]:
                outside = (*outside, index)
                continue
        if abs(y) > touch + match.reaches[index]:
            outside = (*outside, index)
    return Around(near, deep, outside)
