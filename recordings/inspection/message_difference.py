"""The earliest difference of two sequences of messages: a message that one of them lacks, or fields that differ."""

import math
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, NamedTuple

from pydantic_core import from_json

from recordings.reading.recording import RecordedMessage

_MAX_FIELDS = 12
"""Maximum number of fields in a difference."""
BEYOND_NS = 1_000_000_000
"""Simulated time, in ns, that is read after a difference; messages of one tick are closer together in a file."""
_TICK = re.compile(rb'"(?:tick|answers_tick)":(-?\d+)')
"""The tick of a message, in its payload."""


class FieldDifference(NamedTuple):
    """One field: its path, and its value in both recordings; `…` if it is missing."""

    path: str
    first: Any
    second: Any

    @property
    def by(self) -> float | None:
        """The absolute difference of two numbers; None for other values."""
        if any(isinstance(value, bool) or not isinstance(value, int | float) for value in (self.first, self.second)):
            return None
        return float(abs(self.second - self.first))


class Difference(NamedTuple):
    """The first message that differs."""

    key: str
    number: int
    """Number of the message on its key, from 0."""
    time: float
    """Simulated time in s."""
    fields: list[FieldDifference]
    """The fields that differ; empty if the message is missing in one recording."""
    missing_in: str = ""
    """`first` or `second`, if that recording does not have the message."""


def tick_of(recorded: RecordedMessage) -> int:
    """The tick that a message belongs to, or that it answers; where it names none, its log time in ns."""
    found = _TICK.search(recorded.payload)
    return int(found[1]) if found is not None else recorded.log_ns


@dataclass(slots=True)
class _Suspect:
    """The first pair on a key that differs, and what follows it in each recording."""

    key: str
    number: int
    sides: tuple[list[RecordedMessage], list[RecordedMessage]]
    missing_in: str = ""

    @property
    def log_ns(self) -> int:
        return min(side[0].log_ns for side in self.sides if side)

    def difference(self) -> Difference:
        """What differs: the message that one side lacks, or the fields."""
        one, other = self.sides
        missing_in = self.missing_in or _missing_in(one, other)
        if missing_in:
            lacking = one if missing_in == "second" else other
            return Difference(self.key, self.number, lacking[0].time, [], missing_in)
        first, second = one[0], other[0]
        fields = list(islice(_fields("", _read(first.payload), _read(second.payload)), _MAX_FIELDS))
        if first.payload == second.payload:
            fields = [FieldDifference("log time", first.time, second.time)]
        return Difference(self.key, self.number, min(first.time, second.time), fields)


def _missing_in(one: list[RecordedMessage], other: list[RecordedMessage]) -> str:
    """Which recording lacks the first message of the other; empty if the two messages are of one tick."""
    first, second = tick_of(one[0]), tick_of(other[0])
    if first != second:
        return "second" if first < second else "first"
    theirs = [message.payload for message in other if tick_of(message) == first]
    ours = [message.payload for message in one if tick_of(message) == first]
    if ours[0] in theirs[1:] and theirs[0] not in ours:
        return "first"
    if theirs[0] in ours[1:] and ours[0] not in theirs:
        return "second"
    return ""


@dataclass(slots=True)
class EarliestDifference:
    """The earliest difference so far. Each key is compared up to its first difference."""

    _numbers: Counter[str] = field(default_factory=Counter)
    _suspects: dict[str, _Suspect] = field(default_factory=dict)

    def first(self) -> Difference | None:
        """The earliest difference; None if all messages are equal."""
        found = [suspect.difference() for suspect in self._suspects.values()]
        return min(found, key=lambda one: one.time, default=None)

    def is_settled(self, log_ns: int) -> bool:
        """Whether no message from this time on can be an earlier difference, or be part of it."""
        return any(log_ns > suspect.log_ns + BEYOND_NS for suspect in self._suspects.values())

    def compare(self, one: RecordedMessage, other: RecordedMessage) -> bool:
        """Compare two messages of a key without a difference so far; returns whether they are equal."""
        number = self._numbers[one.key]
        self._numbers[one.key] += 1
        if one.payload == other.payload and one.log_ns == other.log_ns:
            return True
        self._suspects[one.key] = _Suspect(one.key, number, ([one], [other]))
        return False

    def add(self, recorded: RecordedMessage, side: int) -> bool:
        """Take a message of a key with a difference, 0 for the first recording; returns whether it is one."""
        suspect = self._suspects.get(recorded.key)
        if suspect is None:
            return False
        if recorded.log_ns <= suspect.log_ns + BEYOND_NS:
            suspect.sides[side].append(recorded)
        return True

    def add_missing(self, recorded: RecordedMessage, missing_in: str) -> None:
        """Note a message that only one of the recordings has."""
        sides: tuple[list[RecordedMessage], list[RecordedMessage]] = ([], [])
        sides[0 if missing_in == "second" else 1].append(recorded)
        self._suspects[recorded.key] = _Suspect(recorded.key, self._numbers[recorded.key], sides, missing_in)


def _read(payload: bytes) -> Any:
    try:
        return from_json(payload)
    except ValueError:
        return payload.decode(errors="backslashreplace")


_MISSING = "…"


def _fields(path: str, one: Any, other: Any) -> Iterator[FieldDifference]:
    """Yield the fields that differ, in the order of the first value."""
    if isinstance(one, dict) and isinstance(other, dict):
        for name in {**one, **other}:
            below = f"{path}.{name}" if path else str(name)
            yield from _fields(below, one.get(name, _MISSING), other.get(name, _MISSING))
    elif isinstance(one, list) and isinstance(other, list):
        for index in range(max(len(one), len(other))):
            left, right = (side[index] if index < len(side) else _MISSING for side in (one, other))
            yield from _fields(f"{path}[{index}]", left, right)
    elif one != other or (isinstance(one, float) and math.copysign(1.0, one) != math.copysign(1.0, other)):
        yield FieldDifference(path, one, other)
