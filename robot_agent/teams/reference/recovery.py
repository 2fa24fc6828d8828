"""Recovery: back out when stuck, fall back to homes when teammates are silent. Pure but for a timer."""

import math
from collections.abc import Sequence

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.skills.go_to import drive
from robot_agent.teams.reference.parameters import Parameters
from schemas.config.sections import Pitch
from schemas.frames import Point
from schemas.messages.command import Drive

HOMES = ((-0.95, 0.0), (0.15, 0.25), (0.15, -0.25), (-0.45, 0.0), (-0.1, 0.0))
"""Where each number is at home, as shares of the pitch's half length and width; further numbers share these."""


def home(number: int, pitch: Pitch) -> Point:
    """Where the robot with this number is looked for while it is silent, m."""
    along, across = HOMES[min(number, len(HOMES)) - 1]
    return along * pitch.goal_line, across * pitch.width


class BackOut:
    """Drives a stuck robot away from what it is stuck at, for a moment."""

    def __init__(self, parameters: Parameters) -> None:
        self._parameters = parameters
        self._left = 0.0
        self._away = 0.0

    def motion(self, me: Body, stuck: float, others: Sequence[Point], dt: float, limits: DriveLimits) -> Drive | None:
        """The drive while it backs out; None for a robot that is free.

        Args:
            stuck: s for which the stuck flag has been up.
            others: places of all other robots.
        """
        self._left = max(0.0, self._left - dt)
        if stuck > self._parameters.stuck_after and self._left == 0.0:
            nearest = min(others, key=lambda place: math.dist(place, me[:2]), default=None)
            ahead = math.atan2(nearest[1] - me.y, nearest[0] - me.x) if nearest is not None else me.heading
            self._away = ahead + math.copysign(self._parameters.stuck_turn, -me.y * math.cos(ahead) or 1.0)
            self._left = self._parameters.stuck_out
        if self._left == 0.0:
            return None
        return drive(me, 1.5 * math.cos(self._away), 1.5 * math.sin(self._away), 0.0, limits)
