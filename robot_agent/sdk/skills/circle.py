"""Drive round a point at a distance, counter-clockwise and facing ahead."""

import math

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.sdk.skills.braking import braking_speed
from robot_agent.sdk.skills.go_to import LAG, drive
from robot_agent.sdk.skills.turn_to import turn_rate
from schemas.frames import rotate
from schemas.messages.command import Drive

_SHARE = 0.5
"""Part of acceleration and turn rate that going round may take; the rest keeps the robot on the circle."""
_JOINS = 0.5
"""m beside the circle within which a robot begins to go round."""


def circle(me: Moving, centre: tuple[float, float], radius: float, limits: DriveLimits) -> Drive:
    """Go to the circle, and round it as fast as the limits allow without leaving it; `radius` in m."""
    dx, dy = me.x - centre[0], me.y - centre[1]
    away = math.hypot(dx, dy)
    out_x, out_y = (dx / away, dy / away) if away > 1e-6 else (math.cos(me.heading), math.sin(me.heading))
    error = radius - away
    speed = min(
        limits.speed, math.sqrt(_SHARE * limits.acceleration * radius), _SHARE * limits.turn_rate * radius
    ) * max(0.0, 1.0 - abs(error) / _JOINS)
    outward = math.copysign(min(limits.speed, braking_speed(abs(error), _SHARE * limits.deceleration, LAG)), error)
    turns = speed / radius
    ahead = math.atan2(out_x, -out_y) + turns * LAG
    vx, vy = rotate(-out_y * speed, out_x * speed, turns * LAG)
    return drive(me, vx + outward * out_x, vy + outward * out_y, turns + turn_rate(me, ahead, limits), limits)
