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


def brake_before(me: Moving, wanted: Drive, opponents: Iterable[Point], radius: float, limits: DriveLimits) -> Drive:
    """The same demand, without the speed toward an opponent that the robot could not brake down to `BUMP`.

    `radius` is that of both hulls, m.
    """
    vx, vy = rotate(wanted.vx, wanted.vy, me.heading)
    changed = False
    for x, y in opponents:
        dx, dy = x - me.x, y - me.y
        toward = vx * dx + vy * dy
        if toward <= 0.0 or abs(dx) + abs(dy) > 2.0 * limits.speed:
            continue
        away = max(math.hypot(dx, dy), 1e-6)
        fast = toward / away - max(BUMP, braking_speed(max(0.0, away - 2.0 * radius), limits.deceleration, LAG))
        if fast > 0.0:
            vx, vy, changed = vx - fast * dx / away, vy - fast * dy / away, True
    return drive(me, vx, vy, wanted.omega, limits) if changed else wanted
