"""Manual control: a person drives a robot in place of its brain."""

from schemas.messages.command import Drive, Kick
from schemas.wire.message import Message

TIMEOUT_S = 0.5
"""Wall time without a message after which a robot is given back to its brain."""


class ManualDrive(Message):
    """Drives a robot while such messages arrive; after half a second without one, its brain has control again."""

    drive: Drive = Drive()
    """Velocity demand in the body frame."""
    dribble: bool = False
    """The dribbler is on."""
    kick: Kick | None = None
    """Carried out in the tick in which this message arrives, or refused; None without a kick."""
    release: bool = False
    """Returns control to the brain at once."""
