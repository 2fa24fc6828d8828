"""What a person tells a robot in place of its brain."""

from schemas.message import Message
from schemas.messages.command import Drive, Kick


class ManualDrive(Message):
    """Drives a robot for as long as such messages come; half a second without one gives it back to its brain."""

    drive: Drive = Drive()
    dribble: bool = False
    kick: Kick | None = None
    """Done in the tick this arrives in, or refused."""
    release: bool = False
    """Gives the robot back at once."""
