"""Finds the first difference of two recordings: a message that one of them lacks, or fields that differ."""

import math
import re
from collections import Counter, deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby, islice, zip_longest
from typing import Any, NamedTuple

from pydantic_core import from_json

from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.reading.log_order import Log, LogMessage
from recordings.reading.recording import RecordedMessage, Recording
from schemas.natural_order import natural_order
from schemas.topics import COMMAND, HEALTH, INVALID, recorded_topic

WALL_TIME_TOPICS = (HEALTH, INVALID)
"""Topics whose messages depend on the speed of the machine; left out by default."""
_MAX_FIELDS = 12
"""Maximum number of fields in a difference."""
_BEYOND_NS = 1_000_000_000
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


@dataclass(slots=True)
class RecordingComparison:
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


Messages = list[RecordedMessage]


def compare(
    one: Recording,
    other: Recording,
    selection: KeySelection = EVERYTHING,
    *,
    everything: bool = False,
    start: float | None = None,
    end: float | None = None,
) -> RecordingComparison:
    """Compare two recordings, key by key, in the order of the messages on each key.

    `start` and `end`, the latter exclusive, are in s of simulated time. Unless `everything` is compared, messages that
    depend on wall time are left out: the health of the host, its log of invalid messages, and commands repeated because
    a sight arrived twice. Log times are compared, times of sending are not.

    Raises:
        TouchlineError: a file is damaged inside.
    """
    keys = {channel.key for recording in (one, other) for channel in recording.channels if channel.messages}
    kept = {key for key in keys if everything or recorded_topic(key) not in WALL_TIME_TOPICS}
    wanted = {key for key in kept if selection.includes(key)}
    comparison = RecordingComparison(left_out=sorted(keys - wanted, key=natural_order), keys=len(wanted))
    numbers: Counter[str] = Counter()
    moments = _moments(*(_messages(recording, wanted, everything, (start, end)) for recording in (one, other)))
    for moment in moments:
        ours, theirs = map(_by_key, moment)
        different = _different(ours, theirs, numbers)
        if different:
            _add_following(different, moments, max(messages[0].log_ns for messages in moment if messages))
            found = [_difference(key, numbers[key], *sides) for key, sides in different.items()]
            comparison.first = min(found, key=lambda difference: difference.time)
            break
    comparison.messages = numbers.total()
    return comparison


def _different(
    ours: dict[str, Messages], theirs: dict[str, Messages], numbers: Counter[str]
) -> dict[str, tuple[Messages, Messages]]:
    """Key → its messages of one log time from the first that differs; those before it are counted in `numbers`."""
    different = {}
    for key in {**ours, **theirs}:
        left, right = ours.get(key, []), theirs.get(key, [])
        pairs = zip(left, right, strict=False)
        equal = next((at for at, (a, b) in enumerate(pairs) if a.payload != b.payload), min(len(left), len(right)))
        numbers[key] += equal
        if max(len(left), len(right)) > equal:
            different[key] = left[equal:], right[equal:]
    return different


def _moments(one: Iterator[RecordedMessage], other: Iterator[RecordedMessage]) -> Iterator[tuple[Messages, Messages]]:
    """Yield the messages of each log time in both recordings; an empty list for a recording that has none then."""
    sides = [(list(group) for _, group in groupby(side, key=lambda one: one.log_ns)) for side in (one, other)]
    left, right = (next(side, []) for side in sides)
    while left or right:
        log_ns = min(messages[0].log_ns for messages in (left, right) if messages)
        is_left, is_right = (bool(messages) and messages[0].log_ns == log_ns for messages in (left, right))
        yield left if is_left else [], right if is_right else []
        left = next(sides[0], []) if is_left else left
        right = next(sides[1], []) if is_right else right


def _by_key(messages: Messages) -> dict[str, Messages]:
    found: dict[str, Messages] = {}
    for message in messages:
        found.setdefault(message.key, []).append(message)
    return found


def _add_following(
    different: dict[str, tuple[Messages, Messages]], moments: Iterator[tuple[Messages, Messages]], log_ns: int
) -> None:
    """Add what follows a difference on its keys: it shows which message is missing."""
    for moment in moments:
        for side, messages in enumerate(moment):
            for message in messages:
                if message.key in different:
                    different[message.key][side].append(message)
        if any(messages and messages[0].log_ns > log_ns + _BEYOND_NS for messages in moment):
            break


def _difference(key: str, number: int, one: Messages, other: Messages) -> Difference:
    """What differs: the message that one side lacks, or the fields."""
    missing_in = _missing_in(one, other)
    if missing_in:
        lacking = one if missing_in == "second" else other
        return Difference(key, number, lacking[0].time, [], missing_in)
    first, second = one[0], other[0]
    fields = list(islice(_fields("", _read(first.payload), _read(second.payload)), _MAX_FIELDS))
    if first.payload == second.payload:
        fields = [FieldDifference("log time", first.time, second.time)]
    return Difference(key, number, min(first.time, second.time), fields)


def _missing_in(one: Sequence[RecordedMessage], other: Sequence[RecordedMessage]) -> str:
    """Which recording lacks the first message of the other; empty if the two messages are of one tick."""
    if not one or not other:
        return "second" if one else "first"
    first, second = _tick_of(one[0]), _tick_of(other[0])
    if first != second:
        return "second" if first < second else "first"
    theirs = [message.payload for message in other if _tick_of(message) == first]
    ours = [message.payload for message in one if _tick_of(message) == first]
    if ours[0] in theirs[1:] and theirs[0] not in ours:
        return "first"
    if theirs[0] in ours[1:] and ours[0] not in theirs:
        return "second"
    return ""


def _tick_of(recorded: RecordedMessage) -> int:
    """The tick that a message belongs to, or that it answers; where it names none, its log time in ns."""
    found = _TICK.search(recorded.payload)
    return int(found[1]) if found is not None else recorded.log_ns


def _messages(
    recording: Recording, keys: set[str], everything: bool, span: tuple[float | None, float | None]
) -> Iterator[RecordedMessage]:
    """Yield the messages on these keys, without the latched ones at the beginning and repeated commands."""
    last: dict[str, bytes] = {}
    start, end = span
    for recorded in recording.messages(start=max(start or 0.0, recording.manifest.begins_ns / 1e9), end=end):
        if recorded.key not in keys:
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


def compare_logs(one: Log, other: Log) -> RecordingComparison:
    """Compare MCAP files of any writers, key by key, in the order of the messages on each key, without their times.

    Raises:
        TouchlineError: a file is damaged inside.
    """
    counts = [Counter[str](), Counter[str]()]
    for side, log in enumerate((one, other)):
        for key, channel in log.channels:
            counts[side][key] += channel.messages
    keys = sorted({*counts[0], *counts[1]}, key=natural_order)
    comparison = RecordingComparison(keys=len(keys))
    waiting: dict[str, deque[tuple[int, LogMessage]]] = {key: deque() for key in keys}
    numbers: Counter[str] = Counter()
    for pair in zip_longest(one.messages(), other.messages()):
        for side, message in enumerate(pair):
            if message is None or numbers[message.key] >= min(count[message.key] for count in counts):
                continue  # what the other file does not have is found below
            queue = waiting[message.key]
            if not queue or queue[0][0] == side:
                queue.append((side, message))
                continue
            first, second = (message, queue.popleft()[1])[:: 1 if side == 0 else -1]
            if (first.payload, first.topic.encoding) != (second.payload, second.topic.encoding):
                comparison.messages = numbers.total()
                comparison.first = Difference(
                    message.key, numbers[message.key], min(first.time, second.time), _content(first, second)
                )
                return comparison
            numbers[message.key] += 1
    comparison.messages = numbers.total()
    for key in keys:
        if counts[0][key] != counts[1][key]:
            lacking = "second" if counts[0][key] > counts[1][key] else "first"
            end = (one if lacking == "second" else other).end_ns / 1e9
            comparison.first = Difference(key, min(count[key] for count in counts), end, [], lacking)
            break
    return comparison


def _content(one: LogMessage, other: LogMessage) -> list[FieldDifference]:
    """The fields of JSON that differ; of other payloads, their encodings, lengths, and first different byte."""
    if one.topic.encoding != other.topic.encoding:
        return [FieldDifference("encoding", one.topic.encoding, other.topic.encoding)]
    if one.topic.encoding == "json":
        return list(islice(_fields("", _read(one.payload), _read(other.payload)), _MAX_FIELDS))
    pairs = enumerate(zip_longest(one.payload, other.payload))
    at = next(number for number, (ours, theirs) in pairs if ours != theirs)
    return [
        FieldDifference(
            f"byte {at}", *(f"{side.payload[at : at + 8].hex(' ')} of {len(side.payload)}" for side in (one, other))
        )
    ]
