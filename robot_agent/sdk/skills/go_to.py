"""Go to a point in a straight line and face a heading, braking in time."""

import math

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.sdk.skills.braking import braking_speed
from robot_agent.sdk.skills.turn_to import turn_rate
from schemas.frames import wrap
from schemas.messages.command import Drive

LAG = 0.12
"""s; how late the velocity follows, with margin against the noise of the position."""
TOLERANCE = 0.03
"""m; closer than this the robot only brakes."""
_SHARE = 0.8
"""Part of the deceleration that braking counts on."""
_BACKS = 2.0
"""rad; a robot on two wheels backs toward what lies farther than this from straight ahead."""
_STANDS = 0.05
"""m/s; at a smaller velocity a robot on two wheels only turns: its direction is noise."""


def go_to(me: Moving, x: float, y: float, heading: float, limits: DriveLimits) -> Drive:
    """Drive straight to (x, y) and stop there."""
    vx, vy = velocity_to(me, x, y, limits)
    return drive(me, vx, vy, turn_rate(me, heading, limits), limits)


def velocity_to(me: Moving, x: float, y: float, limits: DriveLimits) -> tuple[float, float]:
    """The velocity in the team frame that ends at (x, y)."""
    dx, dy = x - me.x, y - me.y
    distance = math.hypot(dx, dy)
    if distance < TOLERANCE:
        return 0.0, 0.0
    speed = min(limits.speed, braking_speed(distance, _SHARE * limits.deceleration, LAG))
    return speed * dx / distance, speed * dy / distance


def drive(me: Moving, vx: float, vy: float, omega: float, limits: DriveLimits) -> Drive:
    """A team-frame velocity as a demand in the body frame, for the heading at which it will act.

    Keeps the direction and scales the length when (vx, vy) is faster than the robot. A robot on two wheels turns toward
    the direction, or its back to it, and drives the faster the better it points there; where it stands, it turns by
    `omega`.

    Raises:
        FaultError: a number that no drive may have.
    """
    speed = math.hypot(vx, vy)
    scale = limits.speed / speed if speed > limits.speed else 1.0
    heading = me.heading + me.omega * limits.tick
    if not limits.sideways and speed > _STANDS:
        return _on_two_wheels(me, vx * scale, vy * scale, heading, limits)
    c, s = math.cos(heading) * scale, math.sin(heading) * scale
    turn = max(-limits.turn_rate, min(limits.turn_rate, omega))
    if not limits.sideways:
        return Drive(omega=turn)
    return Drive(vx=c * vx + s * vy, vy=c * vy - s * vx, omega=turn)


def _on_two_wheels(me: Moving, vx: float, vy: float, heading: float, limits: DriveLimits) -> Drive:
    """A team-frame velocity as a demand of a robot that cannot move sideways, for this heading of its own."""
    direction = math.atan2(vy, vx)
    ahead = math.copysign(1.0, _BACKS - abs(wrap(direction - heading)))
    facing = direction if ahead > 0.0 else direction + math.pi
    speed = ahead * math.hypot(vx, vy) * max(0.0, math.cos(wrap(facing - heading)))
    return Drive(vx=speed, omega=turn_rate(me, facing, limits))
