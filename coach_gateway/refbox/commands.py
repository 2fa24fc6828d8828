"""The box's commands in JSON since 2020 (RefBox 2, jsonCommands.pdf), both ways. Pure."""

import json
from typing import Any, NamedTuple

from schemas.league.signals import SIGNALS, Signal

_OTHER_WORDS = {
    "GAMEOVER": ("GAME_OVER",),
    "DROP_BALL": ("DROPPED_BALL",),
    "HALF_TIME": ("HALFTIME",),
    "SUBGOAL": ("GOAL_MINUS",),
    "SUBSTITUTION": ("SUBSTITUTE",),
    "REPAIR": ("REPAIR_OUT",),
    "REPAIR_END": ("REPAIR_IN",),
    "PARK": ("PARKING",),
}
"""Spellings met beside the code's own: the document's, and older ones."""


def _plain(word: str) -> str:
    return "".join(letter for letter in word.upper() if letter.isalnum())


_BY_WORD: dict[str, Signal] = {
    _plain(word): signal for signal in SIGNALS for word in (signal.name, *_OTHER_WORDS.get(signal.name, ()))
}


class BoxCommand(NamedTuple):
    """One command as the box says it."""

    signal: Signal
    target: str = ""
    """Which team is meant, by the address that the box calls it by; empty for both."""
    robot: int | None = None


class NoCommandError(ValueError):
    """An object that is no command; the sentence says why."""


def read(said: dict[str, Any]) -> BoxCommand:
    """The command in an object; letters' case, underscores and hyphens do not matter, nor do further fields.

    Raises:
        NoCommandError: it has none, or one that nobody knows.
    """
    fields = {_plain(str(key)): value for key, value in said.items()}
    word = fields.get("COMMAND")
    if not isinstance(word, str):
        raise NoCommandError(f"no command in {json.dumps(said)[:60]}")
    signal = _BY_WORD.get(_plain(word))
    if signal is None:
        raise NoCommandError(f'"{word[:40]}" is no command of the referee box')
    target = fields.get("TARGETTEAM")
    return BoxCommand(signal, target.strip() if isinstance(target, str) else "", _robot(fields.get("ROBOTID")))


def write(command: BoxCommand) -> bytes:
    """The command as it goes over the wire."""
    said: dict[str, Any] = {"command": command.signal.name, "targetTeam": command.target}
    if command.robot is not None:
        said["robotID"] = command.robot
    return json.dumps(said).encode() + b"\x00"


def _robot(value: Any) -> int | None:
    """The box says -1 where it means no robot in particular."""
    if isinstance(value, str):
        value = value.strip()
        value = int(value) if value.isascii() and value.isdigit() and len(value) < 4 else None
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return value if isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 1000 else None
