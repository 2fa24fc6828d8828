"""What a person tells a robot in place of its brain."""

from schemas.message import Message
from schemas.messages.command import Drive, Kick

TIMEOUT_S = 0.5
"""Wall time without a message after which a robot is given back to its brain."""


class ManualDrive(Message):
    """Drives a robot for as long as such messages come; half a second without one gives it back to its brain."""

    drive: Drive = Drive()
    """Velocity demand in the body frame."""
    dribble: bool = False
    """The dribbler is on."""
    kick: Kick | None = None
    """Carried out in the tick this message arrives in, or refused; None without a kick."""
    release: bool = False
    """Gives the robot back at once."""
