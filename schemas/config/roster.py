"""The roster of a match: which robots take part, which keeps the goal, and where bodies are placed."""

from collections.abc import Container, Sequence

from schemas.config.config_model import ConfigModel
from schemas.side import Side
from schemas.wire.message import Name
from schemas.wire.part import Part
from schemas.wire.units import Metres, MetresPerSecond, Radians, RadiansPerSecond

MAX_ROBOTS = 11
"""Most robots of one side that a rule book can allow."""
RESERVED = frozenset({"ball"})
"""Names that have another meaning in keys."""


class RosterEntry(ConfigModel):
    """One robot that takes part."""

    name: Name
    """Name of the robot."""
    side: Side
    """The side that it plays for."""
    type: Name = "standard"
    """Type of robot, one of the profile or the match file."""
    agent: bool = True
    """An agent moves it; a robot without one stands still where it is placed."""
    keeper: bool = False
    """The robot is its side's goalkeeper."""


class Placement(Part):
    """The placement of a robot, the ball, or an obstacle that can be pushed, in the field frame; at rest unless it has
    velocities.

    A ball with a velocity on the ground rolls without sliding.
    """

    body: Name
    """Name of a robot or an obstacle, or `ball`."""
    x: Metres
    """x of the centre in the field frame, in m."""
    y: Metres
    """y of the centre in the field frame, in m."""
    heading: Radians = 0.0
    """Heading in the field frame, in rad; a ball has none."""
    z: Metres | None = None
    """Height of the ball's centre in m; None for a ball on the ground. Robots stand on the ground."""
    vx: MetresPerSecond = 0.0
    """Velocity along x of the field frame, in m/s."""
    vy: MetresPerSecond = 0.0
    """Velocity along y of the field frame, in m/s."""
    vz: MetresPerSecond = 0.0
    """Velocity of the ball upward, in m/s."""
    omega: RadiansPerSecond = 0.0
    """Turn rate, in rad/s; a ball has none."""


def goalkeeper_of(robots: Sequence[str], off_field: Container[str]) -> str | None:
    """The goalkeeper of a side that plays with one; None while all its robots are off the field.

    Args:
        robots: the robots of the side, its goalkeeper first.
        off_field: robots that are off the field: sent off, in repair, or waiting as substitutes.
    """
    return next((name for name in robots if name not in off_field), None)
