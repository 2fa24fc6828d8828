"""Finds the first difference of two recordings: by key, message and field."""

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field

from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.inspection.message_difference import BEYOND_NS, Difference, EarliestDifference
from recordings.reading.recording import RecordedMessage, Recording
from schemas.natural_order import natural_order
from schemas.topics import COMMAND, HEALTH, INVALID

WALL_TIME_TOPICS = (HEALTH, INVALID)
"""Topics whose messages depend on the speed of the machine; left out by default."""


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
    one: Recording,
    other: Recording,
    selection: KeySelection = EVERYTHING,
    *,
    everything: bool = False,
    start: float | None = None,
    end: float | None = None,
) -> Comparison:
    """Compare two recordings, key by key, in the order of the messages on each key.

    `start` and `end`, the latter exclusive, are in s of simulated time. Unless `everything` is compared, messages that
    depend on wall time are left out: the health of the host, its log of invalid messages, and commands repeated because
    a sight arrived twice. Log times are compared, times of sending are not.

    Raises:
        TouchlineError: a file is damaged inside.
    """
    keys = {channel.key for recording in (one, other) for channel in recording.channels if channel.messages}
    wanted = {key for key in keys if selection.includes(key) and (everything or not _is_of_wall_time(key))}
    comparison = Comparison(left_out=sorted(keys - wanted, key=natural_order), keys=len(wanted))
    earliest = EarliestDifference()
    span = (start, end)
    sides = (_messages(one, wanted, everything, span), _messages(other, wanted, everything, span))
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
            if earliest.add(recorded, side):
                continue
            partners = waiting[1 - side].get(recorded.key)
            if not partners:
                waiting[side].setdefault(recorded.key, deque()).append(recorded)
                continue
            partner = partners.popleft()
            pair = (recorded, partner) if side == 0 else (partner, recorded)
            if earliest.compare(*pair):
                comparison.messages += 1
            else:  # what waits behind the difference shows which message is missing
                for behind in partners:
                    earliest.add(behind, 1 - side)
                partners.clear()
        if all(sum(map(len, pending.values())) > _MAX_WAITING for pending in waiting):
            break
    read_to_ns = min((times[side] for side in open_sides), default=None)
    for side, pending in enumerate(waiting):
        for left in pending.values():
            if left and (read_to_ns is None or left[0].log_ns < read_to_ns - BEYOND_NS):
                earliest.add_missing(left[0], missing_in="second" if side == 0 else "first")
    comparison.first = earliest.first()
    return comparison


_MAX_WAITING = 200_000
"""Messages without a partner, in each recording, after which the recordings count as unrelated."""


def _is_of_wall_time(key: str) -> bool:
    return any(topic.match(key) is not None for topic in WALL_TIME_TOPICS)


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
