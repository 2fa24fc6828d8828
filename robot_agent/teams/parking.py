"""Where robots of the shipped teams park. Pure."""

from collections.abc import Sequence

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.skills.avoid import circles, go_around
from schemas.messages.command import Drive
from schemas.messages.setup import Setup

_SPEED = 1.5
"""m/s."""
_APART, _ROWS = 1.5, 1.0
"""m between two parked robots, and between two rows of them."""
_AIR = 0.1
"""m between two robots that pass each other."""


def park(me: Body, number: int, others: Sequence[tuple[float, float]], setup: Setup, limits: DriveLimits) -> Drive:
    """Park at the right touch line of the own half, 1.5 m apart as in simatch, in as many rows as necessary."""
    pitch, radius = setup.pitch, setup.robot.reach
    row, place = divmod(number - 1, max(1, int((pitch.goal_line - radius) / _APART)))
    x = -pitch.goal_line + _APART * (place + 1)
    y = -pitch.touch_line + radius + 0.1 + _ROWS * row
    return go_around(me, x, y, 0.0, circles(others, 2.0 * radius + _AIR), limits.capped(_SPEED))
