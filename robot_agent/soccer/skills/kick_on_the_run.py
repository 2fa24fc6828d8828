"""Kick while driving: aim without braking, since the ball leaves along the kick axis at the kick's own speed."""

import math

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.sdk.skills.go_to import drive
from robot_agent.sdk.skills.turn_to import turn_rate
from robot_agent.soccer.skills.kick_at import TURN_RATE
from schemas.frames import wrap
from schemas.messages.command import Drive, Kick, KickMode

_LEAD = 0.04
"""s; two ticks from the sight to the ball's leaving, in which the robot goes on."""
_SLOWS = 0.7
"""Part of the speed that is kept while the robot turns far: a ball that swings is easily lost at speed."""


def kick_on_the_run(
    me: Moving,
    target: tuple[float, float],
    speed: float,
    error: float,
    velocity: tuple[float, float],
    limits: DriveLimits,
    mode: KickMode = KickMode.GROUND,
) -> tuple[Drive, Kick | None]:
    """Aim at the target while driving, and kick once the ball would pass it within `error` m.

    Args:
        velocity: the wanted velocity in the team frame, m/s; lower while the robot still has to turn far.
        speed: the exit speed of the kick, m/s.
    """
    dx, dy = target[0] - me.x - _LEAD * me.vx, target[1] - me.y - _LEAD * me.vy
    heading = math.atan2(dy, dx)
    off = abs(wrap(heading - me.heading - me.omega * limits.tick))
    keeps = 1.0 if off < 0.3 else _SLOWS * max(0.0, math.cos(off))
    turn = turn_rate(me, heading, limits.capped(turn_rate=TURN_RATE))
    aim = drive(me, keeps * velocity[0], keeps * velocity[1], turn, limits)
    ready = off <= math.atan2(error, math.hypot(dx, dy))
    return aim, Kick(mode=mode, speed=speed) if ready else None
