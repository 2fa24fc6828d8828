"""Brake before opponents: a robot without the ball must not drive into them at speed."""

import math
from collections.abc import Iterable

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.sdk.skills.braking import braking_speed
from robot_agent.sdk.skills.go_to import LAG, drive
from schemas.frames import Point, rotate
from schemas.messages.command import Drive

BUMP = 1.0
"""m/s at which a robot may touch an opponent: less than what referees call a charge, to press for the ball."""


def brake_before(
    me: Moving,
    wanted: Drive,
    opponents: Iterable[Point],
    radius: float,
    limits: DriveLimits,
    bump: float = BUMP,
    *,
    hard: bool = False,
) -> Drive:
    """The same demand, without the speed toward an opponent that the robot could not brake down to `bump`, m/s.

    `radius` is that of both hulls, m. `hard`: a robot that is too fast already gains no speed across the way to the
    opponent meanwhile, since a drive that has to do both brakes at half its deceleration.
    """
    vx, vy = rotate(wanted.vx, wanted.vy, me.heading)
    changed = False
    for x, y in opponents:
        dx, dy = x - me.x, y - me.y
        toward, drives = vx * dx + vy * dy, me.vx * dx + me.vy * dy if hard else 0.0
        if (toward <= 0.0 and drives <= 0.0) or abs(dx) + abs(dy) > 2.0 * limits.speed:
            continue
        away = max(math.hypot(dx, dy), 1e-6)
        most = max(bump, braking_speed(max(0.0, away - 2.0 * radius), limits.deceleration, LAG))
        if drives / away > most:
            across, moves = (vy * dx - vx * dy) / away, (me.vy * dx - me.vx * dy) / away
            gain = across - max(min(0.0, moves), min(max(0.0, moves), across))
            vx, vy, changed = vx + gain * dy / away, vy - gain * dx / away, True
        fast = toward / away - most
        if fast > 0.0:
            vx, vy, changed = vx - fast * dx / away, vy - fast * dy / away, True
    return drive(me, vx, vy, wanted.omega, limits) if changed else wanted
