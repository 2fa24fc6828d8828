"""Carry the ball to a point around obstacles, gently enough to keep it."""

from collections.abc import Sequence

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.sdk.skills.avoid import Circle, go_around
from schemas.messages.command import Drive

SPEED = 3.0
"""m/s; with the ball."""
TURN_RATE = 3.5
"""rad/s; with the ball: at a gap of 0.35 m it then swings at little more than 1 m/s."""


def dribble_to(me: Moving, x: float, y: float, heading: float, blocked: Sequence[Circle], limits: DriveLimits) -> Drive:
    """Drive to (x, y) and face `heading`, no faster than the ball can follow."""
    return go_around(me, x, y, heading, blocked, limits.capped(SPEED, TURN_RATE))
