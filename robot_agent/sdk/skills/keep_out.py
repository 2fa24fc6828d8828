"""Keep out of an area before a goal: the part of a velocity that would lead into it is removed."""

from typing import NamedTuple

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.sdk.skills.braking import braking_speed
from robot_agent.sdk.skills.go_to import LAG, drive
from schemas.config.sections import Pitch
from schemas.frames import rotate
from schemas.messages.command import Drive

MARGIN = 0.15
"""m that the robot's centre stays outside the lines."""


class Area(NamedTuple):
    """The goal areas or the penalty areas of a pitch, one before each goal."""

    goal_line: float
    """m; |x| of the goal lines."""
    depth: float
    """m."""
    width: float
    """m."""

    @classmethod
    def goal(cls, pitch: Pitch) -> "Area":
        """The goal areas."""
        return cls(pitch.goal_line, pitch.goal_area_depth, pitch.goal_area_width)

    @classmethod
    def penalty(cls, pitch: Pitch) -> "Area":
        """The penalty areas."""
        return cls(pitch.goal_line, pitch.penalty_area_depth, pitch.penalty_area_width)

    def has(self, end: float, x: float, y: float) -> bool:
        """Whether a place, m, is in the area at the end −1 or 1, the sign of its x."""
        return x * end > self.goal_line - self.depth and abs(y) < 0.5 * self.width


def keep_out(me: Moving, wanted: Drive, area: Area, limits: DriveLimits) -> Drive:
    """The same demand, braked before the front or side line of the area; a robot inside drives out the front."""
    end = 1.0 if me.x > 0 else -1.0
    front = area.goal_line - area.depth - MARGIN - me.x * end
    side = abs(me.y) - 0.5 * area.width - MARGIN
    if front > limits.speed or side > limits.speed:
        return wanted
    vx, vy = rotate(wanted.vx, wanted.vy, me.heading)
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
    """Whether a path from beyond both lines, `front` and `side` m away, leads through the corner into the area."""
    reached = max(front / inward, side / across)
    return reached < 1.0
