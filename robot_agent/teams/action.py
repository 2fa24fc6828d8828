"""What a robot of a shipped team decides in one tick."""

from typing import NamedTuple

from schemas.messages.command import Drive, Kick
from schemas.messages.debug import Debug


class Action(NamedTuple):
    """What a robot does in one tick, with the role and intention that it sends on the radio."""

    role: str
    intention: str
    drive: Drive
    dribble: bool = False
    kick: Kick | None = None
    pass_to: str | None = None
    debug: Debug | None = None
