"""What a robot says in one tick: where it wants to go, what it does with the ball, what it tells its teammates."""

from enum import StrEnum
from typing import Annotated, ClassVar

import msgspec
from msgspec import Meta

from schemas.message import Name
from schemas.struct import Checked, Struct, StructMessage
from schemas.units import Age, Metres, MetresPerSecond, Radians, RadiansPerSecond

MAX_DRIVE = 20.0
"""m/s; a demand beyond any robot's means is a fault of the sender, not a wish."""
MAX_TURN = 50.0
"""rad/s; likewise."""
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
    """Through the point below the bar that the kick axis meets."""
    LOFT = "loft"
    """At the kicker's fixed angle above the ground, wherever that leads."""


class Drive(Struct, frozen=True, kw_only=True, metaclass=Checked):
    """A velocity demand in the body frame: m/s and rad/s."""

    vx: DriveSpeed = 0.0
    vy: DriveSpeed = 0.0
    omega: TurnRate = 0.0


class Kick(Struct, frozen=True, kw_only=True, metaclass=Checked):
    """A kick along the body's x axis.

    `speed` in m/s: the exit speed of a ground kick or one with fixed loft; the horizontal speed of a lob on its way
    through the point under the bar that the kick axis meets, as far as it leads there neither too flat nor too steeply.
    """

    mode: KickMode
    speed: KickSpeed


class BallBelief(Struct, frozen=True, kw_only=True, metaclass=Checked):
    """Where a robot believes the ball to be, in its team frame: m and m/s; `age` in s since it was seen."""

    x: Metres
    y: Metres
    vx: MetresPerSecond = 0.0
    vy: MetresPerSecond = 0.0
    age: Age = 0.0


class Motion(Struct, frozen=True, kw_only=True):
    """Pose and twist of a robot in its team frame: m, rad, m/s, rad/s."""

    x: Metres
    y: Metres
    heading: Radians
    vx: MetresPerSecond = 0.0
    vy: MetresPerSecond = 0.0
    omega: RadiansPerSecond = 0.0


class RadioContent(Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What can be said on the radio; a field that is null or empty is left out where it is sent."""

    self: Motion | None = None
    ball: BallBelief | None = None
    role: ShortText | None = None
    intention: ShortText | None = None
    pass_to: Name | None = None
    """The teammate who is asked to receive a pass."""
    extra: Annotated[dict[ShortText, float | int | bool | ShortText], Meta(max_length=MAX_EXTRA)] = msgspec.field(
        default_factory=dict
    )
    """Whatever else the team agrees on."""


class Radio(RadioContent, frozen=True, kw_only=True, metaclass=Checked):
    """A word to all teammates; the host delivers it with delay and loss, within the team's byte budget.

    A field that is null or empty is left out where it is sent.
    """


class Command(StructMessage, frozen=True, kw_only=True, metaclass=Checked):
    """One robot's answer to one sight."""

    max_bytes: ClassVar[int] = 4096

    answers_tick: Annotated[int, Meta(ge=0)]
    """Tick of the sight."""
    drive: Drive = Drive()
    dribble: bool = False
    """The dribbler is on: a ball that comes within its reach is held."""
    kick: Kick | None = None
    """Done in the tick this command arrives in, or refused."""
    radio: Radio | None = None
    acknowledges_order: int | None = None
    """Sequence number of the newest coach order this robot has taken in."""
