"""The box's commands in JSON since 2020, both ways. Pure."""

import json
from typing import Any, NamedTuple

from schemas.messages.soccer.league.signals import SIGNALS, Signal

_ALIASES = {
    "GAMEOVER": ("GAME_OVER",),
    "DROP_BALL": ("DROPPED_BALL",),
    "HALF_TIME": ("HALFTIME",),
    "SUBGOAL": ("GOAL_MINUS",),
    "SUBSTITUTION": ("SUBSTITUTE",),
    "REPAIR": ("REPAIR_OUT",),
    "REPAIR_END": ("REPAIR_IN",),
    "PARK": ("PARKING",),
}
"""Signal → other spellings in use: those of the league's document, and older ones."""


def _plain(word: str) -> str:
    return "".join(letter for letter in word.upper() if letter.isalnum())


_BY_WORD: dict[str, Signal] = {
    _plain(word): signal for signal in SIGNALS for word in (signal.name, *_ALIASES.get(signal.name, ()))
}


class BoxCommand(NamedTuple):
    """One command of the box."""

    signal: Signal
    target: str = ""
    """The address that the box uses for the team; empty for both teams."""
    robot: int | None = None


class NoCommandError(ValueError):
    """An object that is not a command; the message has the reason."""


def read(content: dict[str, Any]) -> BoxCommand:
    """The command in an object; case, underscores, hyphens and further fields do not matter.

    Raises:
        NoCommandError: there is no command in it, or an unknown one.
    """
    fields = {_plain(str(key)): value for key, value in content.items()}
    word = fields.get("COMMAND")
    if not isinstance(word, str):
        raise NoCommandError(f"no command in {json.dumps(content)[:60]}")
    signal = _BY_WORD.get(_plain(word))
    if signal is None:
        raise NoCommandError(f"{json.dumps(word[:40])} is not a command of the referee box")
    target = fields.get("TARGETTEAM")
    return BoxCommand(signal, target.strip() if isinstance(target, str) else "", _robot(fields.get("ROBOTID")))


def write(command: BoxCommand) -> bytes:
    """The bytes of a command on the wire."""
    content: dict[str, Any] = {"command": command.signal.name, "targetTeam": command.target}
    if command.robot is not None:
        content["robotID"] = command.robot
    return json.dumps(content).encode() + b"\x00"


def _robot(value: Any) -> int | None:
    """The robot's number; None where it is missing, or −1 as the box sends for no robot in particular."""
    if isinstance(value, str):
        value = value.strip()
        value = int(value) if value.isascii() and value.isdigit() and len(value) < 4 else None
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return value if isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 1000 else None
