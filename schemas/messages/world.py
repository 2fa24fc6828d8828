"""The truth of one tick, in the field frame."""

from pydantic import Field

from schemas.config.obstacle import Shape
from schemas.game import OffField
from schemas.message import Message, Name, Part
from schemas.side import Side


class RobotTruth(Part):
    """One robot: position of its centre in m, heading in rad, velocities in m/s and rad/s, in the field frame."""

    x: float
    y: float
    z: float
    heading: float
    vx: float
    vy: float
    omega: float
    holding: bool
    """It has the ball in hand."""
    stuck: bool = False
    """For long it has moved much slower than it was told."""
    off_field: OffField | None = None
    """Why the robot does not take part, or nothing."""


class BallTruth(Part):
    """The ball: position of its centre in m, velocity in m/s, in the field frame."""

    x: float
    y: float
    z: float
    vx: float
    vy: float
    vz: float


class ObstacleTruth(Part):
    """A body that nothing moves: position of its centre in m, heading in rad, in the field frame."""

    x: float
    y: float
    heading: float
    radius: float
    """Of the circle around it on the ground, m."""
    height: float
    """m above the ground."""
    shape: Shape
    size_x: float
    """Of a box along its heading, m; a cylinder's diameter."""
    size_y: float
    """Of a box across, m; a cylinder's diameter."""


class World(Message):
    """Everything there is on the field at one tick."""

    tick: int
    time: float
    """Simulated time in s: tick × control tick."""
    robots: dict[Name, RobotTruth]
    ball: BallTruth
    possession: Name | None = None
    """The robot that holds the ball."""
    touches: list[Name] = Field(default_factory=list)
    """Robots that touched, held or kicked the ball since the tick before, in order of time; left out if nobody did."""
    kicked: Name | None = None
    """The robot whose kick was carried out in this tick; left out if there was none."""
    clock: float = 0.0
    """Game clock in s."""
    obstacles: dict[Name, ObstacleTruth] = Field(default_factory=dict)
    """What else stands on the pitch; not said while there is nothing."""
    episode: int = 1
    """Counts the starts: the match's own, each scene that is loaded, each reset. Ticks and time go on."""


class RobotFrame(Message):
    """The truth of one robot, keyed by its name."""

    tick: int
    time: float
    robot: RobotTruth
    side: Side


class BallFrame(Message):
    """The truth of the ball."""

    tick: int
    time: float
    ball: BallTruth
