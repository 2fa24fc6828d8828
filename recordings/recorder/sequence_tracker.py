"""Follows the sequence numbers of keys, and counts lost, duplicate and late messages.

A key may have several writers, one after the other or at the same time, as a restarted agent or a second agent of a
robot. Each counts its own messages from 0. Messages do not name their writer: it is inferred from number and time of
sending.
"""

from collections import defaultdict
from collections.abc import Iterable

from recordings.container.manifest import KeyCount
from recordings.reading.recording import RecordedMessage
from runtime.bus.contract import ReceivedMessage, Stamp
from schemas.natural_order import natural_order

_REMEMBERED = 10_000
"""Maximum number of missing sequence numbers kept to distinguish late messages from duplicates."""
_MAX_WRITERS = 8
"""Writers of a key that are followed at the same time; the longest silent is forgotten."""
_MAX_RATE = 10_000
"""Most messages that a writer sends in a second on one key: a larger gap is a change of the writer."""
_BURST = 1_000
"""Messages beyond that rate that a writer may send in one burst."""
_SILENT_NS = 1_000_000_000
"""Wall time in ns without a message after which a gap is rather one of another writer."""


class _Writer:
    """The sequence of one writer."""

    __slots__ = ("expected", "missing", "sent_ns")

    def __init__(self) -> None:
        self.expected = self.sent_ns = 0
        self.missing: set[int] = set()


class SequenceTracker:
    """The counts of one key."""

    __slots__ = (
        "_current",
        "_others",
        "bytes",
        "duplicates",
        "late",
        "lost",
        "messages",
        "missed_before_start",
        "restarts",
        "unstamped",
    )

    def __init__(self) -> None:
        self.messages = self.bytes = 0
        self.lost = self.missed_before_start = self.duplicates = self.late = self.restarts = self.unstamped = 0
        self._current: _Writer | None = None
        """The writer of the last message."""
        self._others: list[_Writer] = []
        """Further writers, the longest silent first."""

    def add(self, stamp: Stamp | None, size: int) -> None:
        """Count a message of `size` bytes with this stamp."""
        self.messages += 1
        self.bytes += size
        current = self._current
        if stamp is None:
            self.unstamped += 1
        elif current is not None and stamp.sequence == current.expected:
            current.expected += 1
            current.sent_ns = stamp.sent_ns
        else:
            self._out_of_order(stamp)

    def count(self) -> KeyCount:
        """The current counts."""
        return KeyCount(**{name: getattr(self, name) for name in KeyCount.__struct_fields__})

    def _out_of_order(self, stamp: Stamp) -> None:
        """Count a message that is not the next of the writer of the last message."""
        writers = [self._current, *reversed(self._others)] if self._current is not None else []
        active = [writer for writer in writers if stamp.sent_ns - writer.sent_ns < _SILENT_NS]
        for writer in active:
            if stamp.sequence == writer.expected and stamp.sent_ns >= writer.sent_ns:
                self._follow(writer, stamp)
                return
        for writer in writers:
            if stamp.sequence < writer.expected and stamp.sent_ns <= writer.sent_ns:
                self._from_before(writer, stamp)
                return
        silent = [writer for writer in writers if writer not in active]
        silent.sort(key=lambda writer: writer.expected != stamp.sequence)  # first one whose next message this is
        for writer in (*active, *silent):
            if _is_plausible(writer, stamp):
                self._gap(writer, stamp)
                return
        if writers:
            self.restarts += 1
        self.missed_before_start += stamp.sequence
        self._follow(_Writer(), stamp)

    def _from_before(self, writer: _Writer, stamp: Stamp) -> None:
        """Count a message that a writer sent before its last one."""
        if stamp.sequence in writer.missing:
            writer.missing.discard(stamp.sequence)
            self.lost -= 1
            self.late += 1
        else:
            self.duplicates += 1

    def _gap(self, writer: _Writer, stamp: Stamp) -> None:
        gap = stamp.sequence - writer.expected
        self.lost += gap
        if len(writer.missing) + gap <= _REMEMBERED:
            writer.missing.update(range(writer.expected, stamp.sequence))
        self._follow(writer, stamp)

    def _follow(self, writer: _Writer, stamp: Stamp) -> None:
        """Count a message as the last of this writer, and of the key."""
        writer.expected, writer.sent_ns = stamp.sequence + 1, stamp.sent_ns
        if writer is self._current:
            return
        if writer in self._others:
            self._others.remove(writer)
        if self._current is not None:
            self._others.append(self._current)
        del self._others[: max(0, len(self._others) - _MAX_WRITERS + 1)]
        self._current = writer


def _is_plausible(writer: _Writer, stamp: Stamp) -> bool:
    """Whether a writer can have sent this message after its last one, with the missing ones between them."""
    gap, passed_ns = stamp.sequence - writer.expected, stamp.sent_ns - writer.sent_ns
    return passed_ns >= 0 and 0 <= gap <= _BURST + _MAX_RATE * passed_ns / 1e9


class LossCounts:
    """The trackers of all keys."""

    def __init__(self) -> None:
        self._trackers: defaultdict[str, SequenceTracker] = defaultdict(SequenceTracker)

    def add(self, messages: Iterable[ReceivedMessage | RecordedMessage]) -> None:
        """Count messages."""
        trackers = self._trackers
        for message in messages:
            trackers[message.key].add(message.stamp, len(message.payload))

    def counts(self) -> dict[str, KeyCount]:
        """Key → its counts, sorted."""
        return {key: tracker.count() for key, tracker in self._sorted()}

    @property
    def losses(self) -> dict[str, int]:
        """Key → messages lost; keys without loss are left out."""
        return {key: tracker.lost for key, tracker in self._sorted() if tracker.lost}

    def _sorted(self) -> list[tuple[str, SequenceTracker]]:
        return sorted(self._trackers.items(), key=lambda item: natural_order(item[0]))
