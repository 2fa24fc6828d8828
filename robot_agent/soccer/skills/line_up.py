"""Line up behind the ball for a target, without touching the ball on the way."""

import math
from collections.abc import Sequence

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.sdk.skills.avoid import Circle, bend_speed, go_around, is_in_the_way
from schemas.messages.command import Drive


def behind(ball: tuple[float, float], target: tuple[float, float], distance: float) -> tuple[float, float, float]:
    """The pose `distance` m behind the ball that faces ball and target: x, y, heading."""
    heading = math.atan2(target[1] - ball[1], target[0] - ball[0])
    return ball[0] - distance * math.cos(heading), ball[1] - distance * math.sin(heading), heading


def line_up(
    me: Moving,
    ball: tuple[float, float],
    target: tuple[float, float],
    distance: float,
    blocked: Sequence[Circle],
    limits: DriveLimits,
) -> Drive:
    """Go around the ball, no closer than 0.8 × `distance`, to the place behind it."""
    x, y, heading = behind(ball, target, distance)
    around = Circle(*ball, 0.8 * distance)
    if is_in_the_way(me, x, y, around):
        limits = limits.capped(bend_speed(math.dist(ball, (me.x, me.y)), around.radius, limits))
    return go_around(me, x, y, heading, [*blocked, around], limits)
