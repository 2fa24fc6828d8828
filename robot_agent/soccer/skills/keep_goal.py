"""Keep the own goal: stand where a shot has to pass, and move to where one will pass."""

import math

from robot_agent.sdk.bodies import Ball, DriveLimits, Moving
from robot_agent.sdk.skills.go_to import drive, velocity_to
from robot_agent.sdk.skills.turn_to import turn_rate
from schemas.config.sections import Pitch
from schemas.messages.command import Drive

DEEP = 0.1
"""m of the robot's hull that are behind the goal line: a lob that passes below the bar meets a robot on the line. Of 15
lobs from 4 to 8 m, one scores; with the hull 0.15 m before the line, all do."""
_SHOT_SPEED = 1.0
"""m/s toward the goal line; a slower ball is not a shot."""
_SHOT_TIME = 2.0
"""s to the goal line; a shot that takes longer can wait."""


def keep_goal(me: Moving, ball: Ball, pitch: Pitch, radius: float, limits: DriveLimits) -> Drive:
    """Drive to the guard's place and face the ball."""
    x, y = guard_place(ball, pitch, radius)
    vx, vy = velocity_to(me, x, y, limits)
    shot = shot_place(ball, x, pitch, radius)
    if shot is not None:
        vy = _sprint(shot - me.y, limits)
    facing = math.atan2(ball.y - me.y, ball.x - me.x)
    return drive(me, vx, vy, turn_rate(me, facing, limits), limits)


def guard_place(ball: Ball, pitch: Pitch, radius: float) -> tuple[float, float]:
    """On the goal line, where the angle between ball and posts is halved; between the posts."""
    half = 0.5 * pitch.goal_width
    x = radius - DEEP - pitch.goal_line
    back = min(-pitch.goal_line - ball.x, -0.1)
    left, right = math.hypot(half - ball.y, back), math.hypot(half + ball.y, back)
    slope = ((half - ball.y) / left - (half + ball.y) / right) / (back / left + back / right)
    return x, _between_posts(ball.y + slope * min(x - ball.x, 0.0), pitch, radius)


def shot_place(ball: Ball, x: float, pitch: Pitch, radius: float) -> float | None:
    """Where a ball on its way into the goal crosses the keeper's line; nothing when there is not a shot."""
    if ball.vx > -_SHOT_SPEED:
        return None
    time = (x - ball.x) / ball.vx
    widest = 0.5 * pitch.goal_width
    if not 0.0 < time < _SHOT_TIME or abs(ball.y + ball.vy * time) > widest + 2.0 * radius:
        return None
    return _between_posts(ball.y + ball.vy * time, pitch, radius)


def _between_posts(y: float, pitch: Pitch, radius: float) -> float:
    widest = 0.5 * pitch.goal_width - radius
    return max(-widest, min(widest, y))


def _sprint(way: float, limits: DriveLimits) -> float:
    """Full speed toward the crossing, easing off only over the last centimetres."""
    return max(-limits.speed, min(limits.speed, 8.0 * way))
