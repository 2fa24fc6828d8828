"""Kick a held ball at a target: turn until the kick axis points there, then kick."""

import math

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.sdk.skills.go_to import drive
from robot_agent.sdk.skills.turn_to import turn_rate
from schemas.frames import wrap
from schemas.messages.command import Drive, Kick, KickMode

TURN_RATE = 3.0
"""rad/s; while aiming with the ball. The dribbler of profile `msl` loses half of the balls at 4 rad/s, none at 3."""


def kick_at(
    me: Moving,
    target: tuple[float, float],
    speed: float,
    error: float,
    limits: DriveLimits,
    mode: KickMode = KickMode.GROUND,
) -> tuple[Drive, Kick | None]:
    """Aim, braking to rest, and kick once the ball would pass the target within `error` m."""
    dx, dy = target[0] - me.x, target[1] - me.y
    heading = math.atan2(dy, dx)
    aim = drive(me, 0.0, 0.0, turn_rate(me, heading, limits.capped(turn_rate=TURN_RATE)), limits)
    off = abs(wrap(heading - me.heading - me.omega * limits.tick))
    ready = off <= math.atan2(error, math.hypot(dx, dy))
    return aim, Kick(mode=mode, speed=speed) if ready else None
