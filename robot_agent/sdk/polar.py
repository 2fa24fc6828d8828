"""Places as a camera sees them: distance, and bearing from the kick axis."""

import math
from typing import NamedTuple

from robot_agent.sdk.bodies import Moving
from schemas.frames import wrap


class Polar(NamedTuple):
    """Distance from the robot's centre in m, bearing counter-clockwise from its x axis in rad, in (−π, π]."""

    distance: float
    bearing: float


def polar(me: Moving, x: float, y: float) -> Polar:
    """A point of the team frame from a robot's point of view."""
    dx, dy = x - me.x, y - me.y
    return Polar(math.hypot(dx, dy), wrap(math.atan2(dy, dx) - me.heading))


def point(me: Moving, seen: Polar) -> tuple[float, float]:
    """A place in a robot's polar coordinates as a point of the team frame, m."""
    direction = me.heading + seen.bearing
    return me.x + seen.distance * math.cos(direction), me.y + seen.distance * math.sin(direction)
