"""Receive a coming ball: move into its path, face it, and let it run into the dribbler."""

import math

from robot_agent.sdk.bodies import Ball, DriveLimits, Moving
from robot_agent.sdk.skills.go_to import drive, velocity_to
from robot_agent.sdk.skills.turn_to import turn_rate, turn_to
from schemas.messages.command import Drive

COMES = 0.5
"""m/s; a slower ball does not count as coming."""


def comes(me: Moving, ball: Ball) -> bool:
    """Whether the ball is fast, and nears the robot."""
    nears = ball.vx * (me.x - ball.x) + ball.vy * (me.y - ball.y)
    return nears > 0.0 and math.hypot(ball.vx, ball.vy) > COMES


def receive(me: Moving, ball: Ball, limits: DriveLimits) -> Drive:
    """Go to the nearest point of a coming ball's path, and face the ball; a ball at rest is only faced."""
    speed = math.hypot(ball.vx, ball.vy)
    if speed == 0.0:
        return turn_to(me, math.atan2(ball.y - me.y, ball.x - me.x), limits)
    ux, uy = ball.vx / speed, ball.vy / speed
    along = (me.x - ball.x) * ux + (me.y - ball.y) * uy
    vx, vy = velocity_to(me, ball.x + along * ux, ball.y + along * uy, limits)
    return drive(me, vx, vy, turn_rate(me, math.atan2(-uy, -ux), limits), limits)
