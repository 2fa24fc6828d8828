"""Meet a rolling ball: where and when a robot can be at it first."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from robot_agent.sdk.bodies import Ball, DriveLimits, Moving
from robot_agent.sdk.skills.braking import travel_time
from schemas.config.rolling import Rolling

TIMES = (0.0, 0.25, 0.5, 0.8, 1.2, 1.7, 2.4, 3.5)
"""s from now at which the ball's path is sampled; the meeting is interpolated between them."""
_SURELY = 1e-6
"""m; more than rounding can change."""


class Meeting(NamedTuple):
    """Where and when a robot meets the ball."""

    x: float
    """m; the ball's centre then."""
    y: float
    """m."""
    time: float
    """s from now."""


def way_of(ball: Ball, rolling: Rolling) -> list[Ball]:
    """The ball at each of `TIMES`."""
    if ball.vx == 0.0 == ball.vy:
        return [ball] * len(TIMES)
    return [ball.after(time, rolling) for time in TIMES]


def meet(me: Moving, way: Sequence[Ball], reach: float, limits: DriveLimits, ahead: float = 0.0) -> Meeting:
    """The first point of the ball's path that the robot reaches `ahead` s before the ball, by default with it.

    `reach` is how close to the ball the robot's centre has to come, in m. A robot that is there ahead of the ball has
    turned to it and stands when it comes. For a ball that rests by then, the time is later by `ahead`.
    """
    return _meet(me, way, reach, limits, _last_too_early(me, way, reach, limits, math.inf), ahead)


def meeting_time(me: Moving, way: Sequence[Ball], reach: float, limits: DriveLimits, by: float) -> float:
    """When the robot meets the ball, s from now; for a meeting later than `by`, any time after `by`."""
    begin = _last_too_early(me, way, reach, limits, by)
    return TIMES[begin] if TIMES[begin] > by else _meet(me, way, reach, limits, begin).time


def _meet(
    me: Moving, way: Sequence[Ball], reach: float, limits: DriveLimits, begin: int, ahead: float = 0.0
) -> Meeting:
    """The meeting, searched for from the index `begin` of `TIMES`, which is still too early for it."""
    early = spare = 0.0
    before = way[begin]
    for time, ball in zip(TIMES[begin:], way[begin:], strict=True):
        late = _time_to(me, ball, reach, limits) + ahead - time
        if late <= 0.0:
            part = spare / (spare - late) if spare - late > 1e-9 else 0.0
            return Meeting(
                before.x + part * (ball.x - before.x),
                before.y + part * (ball.y - before.y),
                early + part * (time - early),
            )
        early, spare, before = time, late, ball
    return Meeting(before.x, before.y, early + spare)


def _last_too_early(me: Moving, way: Sequence[Ball], reach: float, limits: DriveLimits, by: float) -> int:
    """Index of the last of `TIMES` before the first at which the robot, always at top speed, could be at the ball.

    Times that are certainly too early need no exact calculation. Beyond `by` s, the first time that is too early.
    """
    at_x, at_y, speed = me.x, me.y, limits.speed
    last = 0
    for index, time in enumerate(TIMES):
        x, y, _, _ = way[index]
        if math.hypot(x - at_x, y - at_y) <= reach + speed * time + _SURELY:
            return last
        last = index
        if time > by:
            return last
    return last


def _time_to(me: Moving, ball: Ball, reach: float, limits: DriveLimits) -> float:
    dx, dy = ball.x - me.x, ball.y - me.y
    distance = math.hypot(dx, dy)
    if distance <= reach:
        return 0.0
    toward = (me.vx * dx + me.vy * dy) / distance
    return travel_time(distance - reach, toward, limits.speed, limits.acceleration, limits.deceleration)
