"""What a robot says in one tick: where it wants to go, what it does with the ball, what it tells its teammates."""

from enum import StrEnum
from typing import Annotated, ClassVar

from pydantic import Field, StringConstraints

from schemas.message import Message, Name, Part

MAX_DRIVE = 20.0
"""m/s; a demand beyond any robot's means is a fault of the sender, not a wish."""
MAX_TURN = 50.0
"""rad/s; likewise."""
MAX_EXTRA = 16
"""Entries in the free part of a radio message."""

ShortText = Annotated[str, StringConstraints(max_length=80)]


class KickMode(StrEnum):
    """How the ball leaves the robot."""

    GROUND = "ground"
    """Rolling along the ground."""
    LOB = "lob"
    """Through the point below the bar that the kick axis meets."""
    LOFT = "loft"
    """At the kicker's fixed angle above the ground, wherever that leads."""


class Drive(Part):
    """A velocity demand in the body frame: m/s and rad/s."""

    vx: Annotated[float, Field(ge=-MAX_DRIVE, le=MAX_DRIVE)] = 0.0
    vy: Annotated[float, Field(ge=-MAX_DRIVE, le=MAX_DRIVE)] = 0.0
    omega: Annotated[float, Field(ge=-MAX_TURN, le=MAX_TURN)] = 0.0


class Kick(Part):
    """A kick along the body's x axis.

    `speed` in m/s: the exit speed of a ground kick or one with fixed loft; the horizontal speed of a lob on its way
    through the point under the bar that the kick axis meets, as far as it leads there neither too flat nor too steeply.
    """

    mode: KickMode
    speed: Annotated[float, Field(gt=0, le=40)]


class BallBelief(Part):
    """Where a robot believes the ball to be, in its team frame: m and m/s; `age` in s since it was seen."""

    x: float
    y: float
    vx: float = 0.0
    vy: float = 0.0
    age: Annotated[float, Field(ge=0)] = 0.0


class Motion(Part):
    """Pose and twist of a robot in its team frame: m, rad, m/s, rad/s."""

    x: float
    y: float
    heading: float
    vx: float = 0.0
    vy: float = 0.0
    omega: float = 0.0


class Radio(Part):
    """A word to all teammates; the host delivers it with delay and loss, within the team's byte budget."""

    self: Motion | None = None
    ball: BallBelief | None = None
    role: ShortText | None = None
    intention: ShortText | None = None
    pass_to: Name | None = None
    """The teammate who is asked to receive a pass."""
    extra: Annotated[dict[ShortText, float | int | bool | ShortText], Field(max_length=MAX_EXTRA)] = Field(
        default_factory=dict
    )
    """Whatever else the team agrees on."""


class Command(Message):
    """One robot's answer to one sight."""

    max_bytes: ClassVar[int] = 4096

    answers_tick: Annotated[int, Field(ge=0)]
    """Tick of the sight."""
    drive: Drive = Drive()
    dribble: bool = False
    """The dribbler is on: a ball that comes within its reach is held."""
    kick: Kick | None = None
    """Done in the tick this command arrives in, or refused."""
    radio: Radio | None = None
    acknowledges_order: int | None = None
    """Sequence number of the newest coach order this robot has taken in."""
