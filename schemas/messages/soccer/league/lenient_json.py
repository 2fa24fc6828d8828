"""Reads values that deviate from the schema: other spellings of keys, numbers as text, null for a number."""

import math
from functools import lru_cache
from typing import Any

from schemas.messages.soccer.league.findings import Findings

KEYS = (
    *(
        "teamName",
        "timestamp",
        "gametimeMs",
        "worldstate",
        "type",
        "intention",
        "robots",
        "balls",
        "obstacles",
        "ageMs",
    ),
    *("id", "pose", "targetPose", "velocity", "batteryLevel", "ballEngaged", "position", "confidence", "radius"),
)
"""Keys as the league's schema spells them."""
REQUIRED = ("type", "teamName", "intention", "robots", "balls", "obstacles", "ageMs")
"""Keys that the schema requires of a world state."""
_OTHER_NAMES = {
    "time": "timestamp",
    "timestampms": "timestamp",
    "gametime": "gametimeMs",
    "worldmodel": "worldstate",
    "team": "teamName",
    "age": "ageMs",
    "ball": "balls",
    "players": "robots",
    "robotid": "id",
    "number": "id",
    "pos": "position",
    "target": "targetPose",
    "vel": "velocity",
    "speed": "velocity",
    "battery": "batteryLevel",
    "hasball": "ballEngaged",
}
_BY_SPELLING = {key.lower(): key for key in KEYS} | _OTHER_NAMES
_LONGEST_KEY = 40
"""Letters of a key that is looked up under other spellings."""
_LARGEST = 1e15
"""No quantity of a log, in its unit, is larger. Chosen here: its square and its hundredfold are still numbers."""
_COMPONENTS = (("x",), ("y",), ("z", "theta", "heading", "phi", "w", "omega"))


@lru_cache(maxsize=1024)
def _canonical(key: str) -> str:
    return _BY_SPELLING.get("".join(letter for letter in key.lower() if letter.isalnum()), key)


def fields_of(value: Any, findings: Findings) -> dict[str, Any]:
    """An object with the schema's spelling of its keys; empty where the value is not an object."""
    if not isinstance(value, dict):
        return {}
    fields: dict[str, Any] = {}
    for key, content in value.items():
        known = _canonical(key) if len(key) <= _LONGEST_KEY else key
        if known != key and known not in value:
            findings.note(f'key "{key}" where the schema has "{known}"')
        if known == key or known not in value:
            fields[known] = content
    return fields


def items_of(value: Any) -> list[Any]:
    """A list; a single object counts as a list of one."""
    if isinstance(value, list):
        return value
    return [value] if isinstance(value, dict) else []


def number(value: Any, what: str, findings: Findings) -> float | None:
    """A number; None where the value is none, or too large."""
    if isinstance(value, str):
        try:
            value = float(value)
            findings.note(f"{what} written as a text")
        except ValueError:
            findings.note(f"{what} is a text that is not a number")
            return None
    if not isinstance(value, int | float):
        return None
    try:
        plain = float(value)
    except OverflowError:
        plain = math.inf
    if not abs(plain) < _LARGEST:
        findings.note(f"{what} is not finite, or beyond any meaning")
        return None
    return plain


def vector(value: Any, length: int, what: str, findings: Findings) -> list[float | None]:
    """A list of `length` coordinates; None for each that is missing."""
    if isinstance(value, dict):
        findings.note(f"{what} is an object of coordinates, not a list")
        value = [next((value[name] for name in names if name in value), None) for names in _COMPONENTS[:length]]
    if not isinstance(value, list):
        return [None] * length
    if len(value) != length:
        findings.note(f"{what} has {len(value)} numbers, not {length}")
    if None in value[:length]:
        findings.note(f"{what} has null for a coordinate")
    numbers = [number(one, what, findings) for one in value[:length]]
    return numbers + [None] * (length - len(numbers))
