"""Finds the first difference of two recordings: by key, message and field."""

import math
from collections import Counter, deque
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, NamedTuple

from pydantic_core import from_json

from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.reading.recording import RecordedMessage, Recording
from schemas.topics import COMMAND, HEALTH, INVALID

WALL_TIME_TOPICS = (HEALTH, INVALID)
"""Topics whose messages depend on the speed of the machine; left out by default."""
_MAX_FIELDS = 12
"""Maximum number of fields in a difference."""
_BEYOND_NS = 1_000_000_000
"""Simulated time, in ns, that is read after a difference; messages of one tick are closer together in a file."""


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


@dataclass(slots=True)
class Comparison:
    """The result of a comparison of two recordings."""

    messages: int = 0
    """Messages that are equal in both."""
    keys: int = 0
    left_out: list[str] = field(default_factory=list)
    """Keys that were not compared."""
    first: Difference | None = None

    @property
    def identical(self) -> bool:
        """Whether no message differs."""
        return self.first is None


def compare(
    one: Recording, other: Recording, selection: KeySelection = EVERYTHING, *, everything: bool = False
) -> Comparison:
    """Compare two recordings, key by key, in the order of the messages on each key.

    Unless `everything` is compared, messages that depend on wall time are left out: the health of the host, its log of
    invalid messages, and commands repeated because a sight arrived twice. Log times are compared, times of sending are
    not.

    Raises:
        TouchlineError: a file is damaged inside.
    """
    keys = {channel.key for recording in (one, other) for channel in recording.channels if channel.messages}
    wanted = {key for key in keys if selection.includes(key) and (everything or not _is_of_wall_time(key))}
    comparison = Comparison(left_out=sorted(keys - wanted), keys=len(wanted))
    earliest = _EarliestDifference()
    sides = (_messages(one, wanted, everything), _messages(other, wanted, everything))
    waiting: tuple[dict[str, deque[RecordedMessage]], ...] = ({}, {})
    times = [-1, -1]
    open_sides = [0, 1]
    while open_sides and not earliest.is_settled(min(times[side] for side in open_sides)):
        for side in tuple(open_sides):
            recorded = next(sides[side], None)
            if recorded is None:
                open_sides.remove(side)
                continue
            times[side] = recorded.log_ns
            partners = waiting[1 - side].get(recorded.key)
            if not partners:
                waiting[side].setdefault(recorded.key, deque()).append(recorded)
                continue
            partner = partners.popleft()
            pair = (recorded, partner) if side == 0 else (partner, recorded)
            comparison.messages += earliest.compare(*pair)
        if all(sum(map(len, pending.values())) > _MAX_WAITING for pending in waiting):
            break
    if not open_sides:
        for side, pending in enumerate(waiting):
            for left in pending.values():
                if left:
                    earliest.add_missing(left[0], missing_in="second" if side == 0 else "first")
    comparison.first = earliest.first
    return comparison


_MAX_WAITING = 200_000
"""Messages without a partner, in each recording, after which the recordings count as unrelated."""


class _EarliestDifference:
    """The earliest difference so far. Each key is compared up to its first difference."""

    def __init__(self) -> None:
        self.first: Difference | None = None
        self._numbers: Counter[str] = Counter()
        self._differing_keys: set[str] = set()

    def is_settled(self, log_ns: int) -> bool:
        """Whether no message from this time on can be an earlier difference."""
        return self.first is not None and log_ns > round(self.first.time * 1e9) + _BEYOND_NS

    def compare(self, one: RecordedMessage, other: RecordedMessage) -> bool:
        """Compare two messages; returns whether they are equal and no earlier message on their key differs."""
        key = one.key
        number = self._numbers[key]
        self._numbers[key] += 1
        if key in self._differing_keys:
            return False
        if one.payload == other.payload and one.log_ns == other.log_ns:
            return True
        fields = [] if one.payload != other.payload else [FieldDifference("log time", one.time, other.time)]
        if not fields:
            fields = list(islice(_fields("", _read(one.payload), _read(other.payload)), _MAX_FIELDS))
        self._note(Difference(key, number, min(one.time, other.time), fields))
        return False

    def add_missing(self, recorded: RecordedMessage, missing_in: str) -> None:
        """Note a message that only one of the recordings has."""
        if recorded.key not in self._differing_keys:
            self._note(Difference(recorded.key, self._numbers[recorded.key], recorded.time, [], missing_in))

    def _note(self, difference: Difference) -> None:
        self._differing_keys.add(difference.key)
        if self.first is None or difference.time < self.first.time:
            self.first = difference


def _is_of_wall_time(key: str) -> bool:
    return any(topic.match(key) is not None for topic in WALL_TIME_TOPICS)


def _messages(recording: Recording, keys: set[str], everything: bool) -> Iterator[RecordedMessage]:
    """Yield the messages on these keys, without the latched ones at the beginning and repeated commands."""
    last: dict[str, bytes] = {}
    for number, recorded in enumerate(recording.messages()):
        if recorded.key not in keys or number < recording.manifest.latched_count:
            continue
        if recorded.topic.key == COMMAND.key and not everything:
            if last.get(recorded.key) == recorded.payload:
                continue
            last[recorded.key] = recorded.payload
        yield recorded


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
