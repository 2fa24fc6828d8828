"""What the hardware of a robot implements: one class between a brain and the devices of a body."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

from schemas.config.robot_model import RobotModel
from schemas.config.sensors.table import Reading
from schemas.messages.command import Drive, Kick
from schemas.messages.radio import Motion
from schemas.messages.sight import Obstacle


class BodyBall(NamedTuple):
    """The ball in a picture, in the body frame: x in the kicking direction, y to the left."""

    x: float
    """m."""
    y: float
    """m."""
    vx: float = 0.0
    """m/s over the ground."""
    vy: float = 0.0
    """m/s over the ground."""
    z: float | None = None
    """Height of the centre above the ground in m; None where the camera does not measure it."""


class Picture(NamedTuple):
    """What a camera has found in one picture, in the body frame at the time at which it was taken."""

    time: float
    """When it was taken: s on the clock of `sense`."""
    ball: BodyBall | None = None
    """None where the picture does not show it."""
    obstacles: tuple[Obstacle, ...] = ()
    """Robots and other bodies, in any order: x, y and radius in m."""


@dataclass(frozen=True, slots=True)
class SensorReadings:
    """What the sensors of a robot have measured since the last call; a sensor without news is left out."""

    time: float
    """When the motion was measured: s on the clock of `sense`, at most its argument."""
    motion: Motion | None = None
    """Pose and twist of the robot in the field frame, by its own localisation: m, rad, m/s, rad/s."""
    picture: Picture | None = None
    """The newest picture, once."""
    holding: bool = False
    """The ball is at the kicker, and can be kicked."""
    kicker_ready: bool = True
    """The kicker is charged."""
    stuck: bool = False
    """The robot moves much slower than demanded; False where nothing measures it."""
    sensors: Mapping[str, Reading] = field(default_factory=dict)
    """Sensor of the profile → a new reading, whose `age` is that at `time`."""
    unreadable: int = 0
    """Messages of devices since the last call that could not be read, as by a wrong checksum."""


class Hardware(Protocol):
    """The body of one robot. Its methods are called one at a time.

    `sense` and `actuate` may take a deadline, by default 20 ms; longer calls are counted. The others may take a while.

    An exception of any method is an error: the robot falls back, and the hardware is closed. Devices should stop by
    themselves when nothing has come for 0.2 s: no process can stop motors after it has died.
    """

    def __init__(self, model: RobotModel, **options: Any) -> None:
        """`model` has the numbers of this robot: body, drive, wheels; `options` are those of the hardware's file."""

    def configure(self) -> None:
        """Open the devices and begin to measure; nothing may move. Unconfigured → inactive."""

    def activate(self) -> None:
        """Power motors, kicker and dribbler, at rest; called only where the robot is armed. Inactive → active."""

    def sense(self, time: float) -> SensorReadings:
        """What was measured since the last call. It returns at once, with what there is.

        `time` is now, in s on a clock that begins with the process; called at the control rate of the profile, 50 Hz,
        inactive and active.
        """

    def actuate(self, drive: Drive | None, kick: Kick | None, dribble: bool) -> None:
        """Drive with this velocity in the body frame until the next call; called at the control rate while active.

        The demand is within the limits of the model, in speed, turn rate, rim speeds and acceleration. None as `drive`
        takes the power from the motors. A kick is to be made once.
        """

    def deactivate(self) -> None:
        """Bring the robot to rest and take the power away. Active → inactive; also called after an error."""

    def close(self) -> None:
        """Close the devices; called once, at the end, in any state."""
