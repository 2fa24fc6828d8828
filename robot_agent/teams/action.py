"""What a robot of a shipped team decides in one tick."""

from collections.abc import Callable
from types import NoneType
from typing import Any, NamedTuple

from robot_agent.loading.user_code import ReturnedError
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


_TEXT = "text of at most 80 characters"
_PARTS: dict[str, tuple[type | tuple[type, ...], str]] = {
    "role": (str, _TEXT),
    "intention": (str, _TEXT),
    "drive": (Drive, "a Drive"),
    "kick": ((Kick, NoneType), "a Kick or None"),
    "pass_to": ((str, NoneType), "a robot's name or None"),
    "debug": ((Debug, NoneType), "drawing.debug() or None"),
}
"""Field of an action → its type, and that type in words."""


def checked(action: object, play: Callable[..., Any]) -> Action:
    """What `play` returned, if it is an action of the right parts.

    Raises:
        ReturnedError: it is none; the text names the place of `play`.
    """
    if not isinstance(action, Action):
        raise ReturnedError("play", repr(action), play, "return an Action")
    for name, (kind, words) in _PARTS.items():
        value = getattr(action, name)
        if not isinstance(value, kind) or (words is _TEXT and len(str(value)) > 80):
            raise ReturnedError("play", f"an Action with {name} {value!r}", play, f"give {words}")
    return action
