"""The truth of one tick, in the field frame."""

from typing import ClassVar

from schemas.config.obstacle import Shape
from schemas.config.sensors.table import Reading
from schemas.errors import NoBallError
from schemas.side import Side
from schemas.soccer.game import OffField
from schemas.wire.message import WITHOUT_SENSORS, Message, Name
from schemas.wire.part import Part


class RobotTruth(Part):
    """True state of one robot, in the field frame."""

    x: float
    """x of the centre in the field frame, in m."""
    y: float
    """y of the centre in the field frame, in m."""
    z: float
    """Height of the centre above the ground, in m."""
    heading: float
    """Kicking direction in the field frame, counter-clockwise from +x, in rad."""
    vx: float
    """Velocity along x of the field frame, in m/s."""
    vy: float
    """Velocity along y of the field frame, in m/s."""
    omega: float
    """Turn rate, counter-clockwise, in rad/s."""
    holding: bool
    """The robot holds the ball."""
    stuck: bool = False
    """The robot has moved much slower than commanded for a while."""
    off_field: OffField | None = None
    """Why the robot does not take part; None while it does."""


class BallTruth(Part):
    """True state of the ball, in the field frame."""

    x: float
    """x of the centre in the field frame, in m."""
    y: float
    """y of the centre in the field frame, in m."""
    z: float
    """Height of the centre above the ground, in m."""
    vx: float
    """Velocity along x of the field frame, in m/s."""
    vy: float
    """Velocity along y of the field frame, in m/s."""
    vz: float
    """Velocity upward, in m/s."""


class PushedTruth(Part):
    """What an obstacle that can be pushed has besides its place, in the field frame."""

    vx: float
    """Velocity along x of the field frame, in m/s."""
    vy: float
    """Velocity along y of the field frame, in m/s."""
    omega: float
    """Turn rate, counter-clockwise, in rad/s."""
    mass: float
    """Mass in kg."""
    friction: float
    """Coefficient of friction on the ground."""


class ObstacleTruth(Part, omit_defaults=True):
    """Place and size of an obstacle, in the field frame."""

    x: float
    """x of the centre in the field frame, in m."""
    y: float
    """y of the centre in the field frame, in m."""
    heading: float
    """Direction of a box's `size_x` in the field frame, in rad."""
    radius: float
    """Radius of the circle around it on the ground, in m."""
    height: float
    """Height above the ground, in m."""
    shape: Shape
    """Cylinder or box."""
    size_x: float
    """Size of a box along its heading, or a cylinder's diameter, in m."""
    size_y: float
    """Size of a box across its heading, or a cylinder's diameter, in m."""
    pushed: PushedTruth | None = None
    """Velocity and mass of an obstacle that can be pushed; omitted for one that stands fast."""


class World(Message):
    """True state of everything on the field at one tick."""

    max_bytes: ClassVar[int] = 2 * 65_536
    """As many readings as 22 robots may have."""
    omitted: ClassVar[bytes] = WITHOUT_SENSORS

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    robots: dict[Name, RobotTruth]
    """Robot → its true state."""
    ball: BallTruth | None
    """True state of the ball; None in a game without one."""
    possession: Name | None = None
    """The robot that holds the ball; None while no robot does."""
    touches: list[Name] = []
    """Robots that touched, held or kicked the ball since the tick before, in order of time; omitted while empty."""
    level: list[Name] = []
    """The last robots of `touches`, if they touched the ball at the same time and equally hard; omitted while empty."""
    kicked: Name | None = None
    """The robot whose kick was carried out in this tick; omitted without one."""
    clock: float = 0.0
    """Game clock in s."""
    obstacles: dict[Name, ObstacleTruth] = {}
    """Obstacle → its place and size; omitted while empty."""
    episode: int = 1
    """Counts the starts of the world: the match's own, each scene that is loaded, each reset. Ticks and time go on."""
    sensors: dict[Name, dict[Name, Reading]] = {}
    """Robot → sensor → the reading taken in this tick, in the robot's frame; omitted without any."""

    @property
    def match_ball(self) -> BallTruth:
        """The ball of a game that has one.

        Raises:
            NoBallError: the game has none.
        """
        if self.ball is None:
            raise NoBallError
        return self.ball


class RobotFrame(Message):
    """True state of one robot at one tick."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    robot: RobotTruth
    """True state of the robot."""
    side: Side
    """The robot's side."""


class BallFrame(Message):
    """True state of the ball at one tick."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    ball: BallTruth
    """True state of the ball."""
