"""Keep out of the goal areas: the part of a velocity that would lead into one is taken away."""

import math

from robot_agent.bodies import Body, Limits
from robot_agent.skills.braking import braking_speed
from robot_agent.skills.go_to import LAG, drive
from schemas.command import Drive
from schemas.profile import Field

MARGIN = 0.15
"""m that the robot's centre stays outside the lines."""


def keep_out(me: Body, wanted: Drive, pitch: Field, limits: Limits) -> Drive:
    """The same demand, braked before the front or side line of a goal area; a robot inside drives out the front."""
    end = 1.0 if me.x > 0 else -1.0
    front = pitch.goal_line - pitch.goal_area_depth - MARGIN - me.x * end
    side = abs(me.y) - 0.5 * pitch.goal_area_width - MARGIN
    if front > limits.speed or side > limits.speed:
        return wanted
    c, s = math.cos(me.heading), math.sin(me.heading)
    vx, vy = c * wanted.vx - s * wanted.vy, s * wanted.vx + c * wanted.vy
    if front <= 0.0 and side <= 0.0:
        return drive(me, -end * 1.0, vy, wanted.omega, limits)
    outward = 1.0 if me.y > 0 else -1.0
    if front > 0.0 and side < 0.0:
        vx = end * min(vx * end, braking_speed(front, limits.deceleration, LAG))
    elif side > 0.0 and front < 0.0:
        vy = -outward * min(-vy * outward, braking_speed(side, limits.deceleration, LAG))
    elif vx * end > 0.0 and vy * outward < 0.0 and _enters(front, side, vx * end, -vy * outward):
        vx = end * min(vx * end, braking_speed(front, limits.deceleration, LAG))
    return drive(me, vx, vy, wanted.omega, limits)


def _enters(front: float, side: float, inward: float, across: float) -> bool:
    """Whether a way from beyond both lines, `front` and `side` m away, leads through the corner into the area."""
    reached = max(front / inward, side / across)
    return reached < 1.0
