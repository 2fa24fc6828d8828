"""A robot's command for one tick: drive, dribbler, kick, and a radio message."""

from enum import StrEnum
from typing import Annotated, ClassVar

from msgspec import Meta

from schemas.messages.debug import MAX_BYTES as MAX_DEBUG_BYTES
from schemas.messages.debug import Debug
from schemas.messages.radio import Radio
from schemas.wire.checked import Checked
from schemas.wire.message import Message, ShortText
from schemas.wire.part import Part

MAX_DRIVE = 20.0
"""m/s; a demand that no robot can meet is an error of the sender, perhaps of its units."""
MAX_TURN = 50.0
"""rad/s; the same."""
DriveSpeed = Annotated[float, Meta(ge=-MAX_DRIVE, le=MAX_DRIVE, extra={"unit": "m/s"})]
TurnRate = Annotated[float, Meta(ge=-MAX_TURN, le=MAX_TURN, extra={"unit": "rad/s"})]
KickSpeed = Annotated[float, Meta(gt=0, le=40, extra={"unit": "m/s"})]


class KickMode(StrEnum):
    """How the ball leaves the robot."""

    GROUND = "ground"
    """Rolling along the ground."""
    LOB = "lob"
    """Solved to pass below the bar where the kick axis meets the goal."""
    LOFT = "loft"
    """At the kicker's fixed angle above the ground."""


class Drive(Part, metaclass=Checked):
    """A velocity demand in the body frame: x in the kicking direction, y to the left."""

    vx: DriveSpeed = 0.0
    """Velocity in the kicking direction, in m/s."""
    vy: DriveSpeed = 0.0
    """Velocity to the left, in m/s."""
    omega: TurnRate = 0.0
    """Turn rate, counter-clockwise, in rad/s."""


class Kick(Part, metaclass=Checked):
    """A kick along the body's x axis."""

    mode: KickMode
    """How the ball leaves the robot."""
    speed: KickSpeed
    """Exit speed of a ground kick or a kick with fixed loft, in m/s. For a lob, its horizontal speed in m/s: the angle
    is solved so that the ball passes under the bar where the kick axis meets it, within the kicker's limits."""


class Command(Message, metaclass=Checked):
    """One robot's answer to one sight."""

    max_bytes: ClassVar[int] = 4096 + MAX_DEBUG_BYTES

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
    refuses_order: ShortText = ""
    """Why this robot does not carry out that order, such as `unknown test: machine`; empty while it does."""
    debug: Debug | None = None
    """Values and shapes for the robot's authors, in the team frame; None without any. They have no effect on the match,
    and only the robot's own coach, the operator and recorders receive them."""
