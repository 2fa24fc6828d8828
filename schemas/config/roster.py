"""The roster of a match: which robots take part, and where bodies are set down."""

from schemas.message import Name, Part
from schemas.side import Side

MAX_ROBOTS = 5
"""Robots of one side, rule book 10.2."""
RESERVED = frozenset({"ball"})
"""Names that mean something else in a key."""


class RosterEntry(Part):
    """One robot that takes part."""

    name: Name
    side: Side
    type: Name = "standard"
    """As the profile or the match file names it."""
    agent: bool = True
    """An agent moves it; without, it stands still wherever it is set down."""
    keeper: bool = False
    """It is its side's goalkeeper."""


class Placement(Part):
    """A body that was set down by hand: `body` is a robot's name or `ball`; field frame, at rest unless it says more.

    A ball that is set rolling on the ground rolls without sliding.
    """

    body: Name
    x: float
    y: float
    heading: float = 0.0
    z: float | None = None
    """Height of the ball's centre in m; on the ground when not given. Robots stand on the ground."""
    vx: float = 0.0
    vy: float = 0.0
    vz: float = 0.0
    """Of the ball alone."""
    omega: float = 0.0
    """Of a robot alone."""
