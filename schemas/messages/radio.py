"""Radio messages between teammates, and the beliefs that the host publishes from them."""

from typing import Annotated

from msgspec import Meta

from schemas.soccer.game import Point
from schemas.wire.checked import Checked
from schemas.wire.message import Message, Name, ShortText
from schemas.wire.part import Part
from schemas.wire.units import Age, Finite, Metres, MetresPerSecond, Radians, RadiansPerSecond

MAX_EXTRA = 16
"""Entries in the free part of a radio message."""
MAX_OBSTACLES = 32
"""Obstacles in a radio message."""


class BallBelief(Part, metaclass=Checked):
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


class Motion(Part):
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


class RadioContent(Part, omit_defaults=True):
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
    extra: Annotated[dict[ShortText, Finite | int | bool | ShortText], Meta(max_length=MAX_EXTRA)] = {}
    """Further values that the team's own code defines, by name."""


class Radio(RadioContent, metaclass=Checked):
    """A message to all teammates and the coach; the host delivers it with delay and loss, within the team's bit budget.

    Fields that are null or empty are omitted when it is sent.
    """

    obstacles: Annotated[list[Point], Meta(max_length=MAX_OBSTACLES)] = []
    """Where the sender believes opponents and other bodies to be that are no teammates, in the team frame. Only the
    coach receives them; they count toward the budget."""


class Belief(Message):
    """A robot's radio message, as the host received it."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    robot: Name
    """The robot that sent the radio message."""
    radio: Radio
    """The radio message, in the robot's team frame."""
