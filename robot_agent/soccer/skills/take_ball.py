"""Take the ball: meet it, face it, and close in until the dribbler holds it; from the front if an opponent has it."""

import math
from collections.abc import Iterable, Sequence

from robot_agent.sdk.bodies import Ball, DriveLimits, Moving
from robot_agent.sdk.skills.avoid import Circle, circles_near, steer
from robot_agent.sdk.skills.braking import braking_speed
from robot_agent.sdk.skills.go_to import LAG, drive, velocity_to
from robot_agent.sdk.skills.turn_to import turn_rate
from robot_agent.soccer.skills.intercept import Meeting
from schemas.messages.command import Drive

CLOSE = 0.9
"""m; within this distance the robot follows the ball itself rather than the meeting point."""
HAS_IT = 0.5
"""m; an opponent this close to the ball has it."""
_CLOSING = 0.4
"""m/s; speed relative to the ball at the touch: with less the robot never arrives."""


def take_ball(
    me: Moving,
    ball: Ball,
    meeting: Meeting,
    gap: float,
    opponents: Sequence[tuple[float, float]],
    clearance: float,
    limits: DriveLimits,
    mates: Iterable[tuple[float, float]] = (),
) -> Drive:
    """Drive to the ball and face it.

    `gap`: distance of the centres while it is held; `clearance`: distance of the robot's centre from opponents
    and teammates on its path; m.
    """
    dx, dy = ball.x - me.x, ball.y - me.y
    distance = math.hypot(dx, dy)
    facing = math.atan2(dy, dx)
    front = front_of_holder(me, ball, opponents, gap)
    blocked = circles_near(me, [*opponents, *mates], clearance)
    if front is not None:
        velocity = _go(me, *front, blocked, limits)
        velocity = velocity[0] + ball.vx, velocity[1] + ball.vy
    elif distance > CLOSE:
        way_x, way_y = meeting.x - me.x, meeting.y - me.y
        way = math.hypot(way_x, way_y)
        short = max(0.0, 1.0 - gap / way) if way > 1e-6 else 0.0
        velocity = _go(me, me.x + way_x * short, me.y + way_y * short, blocked, limits)
    else:
        velocity = _closing_in(me, ball, distance, facing, gap, limits)
    return drive(me, *velocity, turn_rate(me, facing, limits), limits)


def front_of_holder(
    me: Moving, ball: Ball, opponents: Sequence[tuple[float, float]], gap: float
) -> tuple[float, float] | None:
    """The place in front of an opponent that has the ball; None for a robot on that side of the ball already."""
    for x, y in opponents:
        away_x, away_y = ball.x - x, ball.y - y
        away = math.hypot(away_x, away_y)
        if not 1e-6 < away < HAS_IT:
            continue
        behind = (me.x - ball.x) * away_x + (me.y - ball.y) * away_y
        if behind < 0.3 * away * math.hypot(me.x - ball.x, me.y - ball.y):
            return ball.x + away_x / away * gap, ball.y + away_y / away * gap
    return None


def _go(me: Moving, x: float, y: float, blocked: Sequence[Circle], limits: DriveLimits) -> tuple[float, float]:
    vx, vy = velocity_to(me, x, y, limits)
    return steer(me, vx, vy, math.hypot(x - me.x, y - me.y), blocked)


def _closing_in(
    me: Moving, ball: Ball, distance: float, facing: float, gap: float, limits: DriveLimits
) -> tuple[float, float]:
    """The ball's velocity plus what closes the gap; slower while the ball is beside the kick axis."""
    aligned = max(0.0, math.cos(facing - me.heading))
    closing = _CLOSING + braking_speed(distance - gap, 0.5 * limits.deceleration, LAG)
    closing *= aligned**4
    c, s = math.cos(facing), math.sin(facing)
    return ball.vx + closing * c, ball.vy + closing * s
