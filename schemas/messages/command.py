"""A robot's command for one tick: drive, dribbler, kick, and a radio message to its teammates."""

from enum import StrEnum
from typing import Annotated, ClassVar

import msgspec
from msgspec import Meta

from schemas.wire.message import Name
from schemas.wire.struct import Checked, Struct, StructMessage
from schemas.wire.units import Age, Metres, MetresPerSecond, Radians, RadiansPerSecond

MAX_DRIVE = 20.0
"""m/s; a demand that no robot can meet is an error of the sender, perhaps of its units."""
MAX_TURN = 50.0
"""rad/s; the same."""
MAX_EXTRA = 16
"""Entries in the free part of a radio message."""

DriveSpeed = Annotated[float, Meta(ge=-MAX_DRIVE, le=MAX_DRIVE, extra={"unit": "m/s"})]
TurnRate = Annotated[float, Meta(ge=-MAX_TURN, le=MAX_TURN, extra={"unit": "rad/s"})]
KickSpeed = Annotated[float, Meta(gt=0, le=40, extra={"unit": "m/s"})]
ShortText = Annotated[str, Meta(max_length=80)]


class KickMode(StrEnum):
    """How the ball leaves the robot."""

    GROUND = "ground"
    """Rolling along the ground."""
    LOB = "lob"
    """Solved to pass below the bar where the kick axis meets the goal."""
    LOFT = "loft"
    """At the kicker's fixed angle above the ground."""


class Drive(Struct, frozen=True, kw_only=True, metaclass=Checked):
    """A velocity demand in the body frame: x in the kicking direction, y to the left."""

    vx: DriveSpeed = 0.0
    """Velocity in the kicking direction, in m/s."""
    vy: DriveSpeed = 0.0
    """Velocity to the left, in m/s."""
    omega: TurnRate = 0.0
    """Turn rate, counter-clockwise, in rad/s."""


class Kick(Struct, frozen=True, kw_only=True, metaclass=Checked):
    """A kick along the body's x axis."""

    mode: KickMode
    """How the ball leaves the robot."""
    speed: KickSpeed
    """Exit speed of a ground kick or a kick with fixed loft, in m/s. For a lob, its horizontal speed in m/s: the angle
    is solved so that the ball passes under the bar where the kick axis meets it, within the kicker's limits."""


class BallBelief(Struct, frozen=True, kw_only=True, metaclass=Checked):
    """Where a robot believes the ball to be, in its team frame."""

    x: Metres
    """x of the ball's centre in the team frame, in m."""
    y: Metres
    """y of the ball's centre in the team frame, in m."""
    vx: MetresPerSecond = 0.0
    """Velocity along x of the team frame, in m/s."""
    vy: MetresPerSecond = 0.0
    """Velocity along y of the team frame, in m/s."""
    age: Age = 0.0
    """Simulated time since the robot last saw the ball, in s."""


class Motion(Struct, frozen=True, kw_only=True):
    """Pose and twist of a robot in its team frame."""

    x: Metres
    """x of the centre in the team frame, in m."""
    y: Metres
    """y of the centre in the team frame, in m."""
    heading: Radians
    """Kicking direction in the team frame, counter-clockwise from +x, in rad."""
    vx: MetresPerSecond = 0.0
    """Velocity along x of the team frame, in m/s."""
    vy: MetresPerSecond = 0.0
    """Velocity along y of the team frame, in m/s."""
    omega: RadiansPerSecond = 0.0
    """Turn rate, counter-clockwise, in rad/s."""


class RadioContent(Struct, frozen=True, kw_only=True, omit_defaults=True):
    """The content of a radio message; fields that are null or empty are omitted when it is sent."""

    self: Motion | None = None
    """Pose and twist of the sender, as it measures them; None where it does not send them."""
    ball: BallBelief | None = None
    """Where the sender believes the ball to be; None where it does not send it."""
    role: ShortText | None = None
    """The sender's role in its team; the team's own code defines the values."""
    intention: ShortText | None = None
    """What the sender is about to do; the team's own code defines the values."""
    pass_to: Name | None = None
    """The teammate that is asked to receive a pass; None without a pass."""
    extra: Annotated[dict[ShortText, float | int | bool | ShortText], Meta(max_length=MAX_EXTRA)] = msgspec.field(
        default_factory=dict
    )
    """Further values that the team's own code defines, by name."""


class Radio(RadioContent, frozen=True, kw_only=True, metaclass=Checked):
    """A message to all teammates; the host delivers it with delay and loss, within the team's bit budget.

    Fields that are null or empty are omitted when it is sent.
    """


class Command(StructMessage, frozen=True, kw_only=True, metaclass=Checked):
    """One robot's answer to one sight."""

    max_bytes: ClassVar[int] = 4096

    answers_tick: Annotated[int, Meta(ge=0)]
    """Tick of the sight that this command answers."""
    drive: Drive = Drive()
    """Velocity demand in the body frame; it stays in force until the next command or the watchdog."""
    dribble: bool = False
    """The dribbler is on: a ball that comes within its reach is held."""
    kick: Kick | None = None
    """Carried out in the tick in which this command arrives, or refused; None without a kick."""
    radio: Radio | None = None
    """Message to all teammates; None without one."""
    acknowledges_order: int | None = None
    """Sequence number of the newest coach order that this robot has received; None before the first."""
