"""Follows the sequence numbers of one key, and counts lost, duplicate and late messages."""

from recordings.container.manifest import KeyCount
from schemas.bus.contract import Stamp

_REMEMBERED = 10_000
"""Maximum number of missing sequence numbers kept to distinguish late messages from duplicates."""


class SequenceTracker:
    """The counts of one key."""

    __slots__ = (
        "_expected",
        "_missing",
        "_sent_ns",
        "bytes",
        "duplicates",
        "late",
        "left_out",
        "lost",
        "messages",
        "missed_before_start",
        "restarts",
        "unstamped",
    )

    def __init__(self) -> None:
        self.messages = self.bytes = self.left_out = 0
        self.lost = self.missed_before_start = self.duplicates = self.late = self.restarts = self.unstamped = 0
        self._expected = -1
        self._sent_ns = 0
        self._missing: set[int] = set()

    def add(self, stamp: Stamp | None, size: int, left_out: bool = False) -> None:
        """Count a message of `size` bytes with this stamp; with `left_out`, it is not in the file."""
        if left_out:
            self.left_out += 1
        else:
            self.messages += 1
            self.bytes += size
        if stamp is None:
            self.unstamped += 1
        elif stamp.sequence == self._expected:
            self._expected += 1
            self._sent_ns = stamp.sent_ns
        elif self._expected < 0:
            self.missed_before_start += stamp.sequence
            self._expect_after(stamp)
        elif stamp.sequence > self._expected:
            self._gap(stamp)
        else:
            self._from_before(stamp)

    def count(self) -> KeyCount:
        """The current counts."""
        return KeyCount(**{name: getattr(self, name) for name in KeyCount.model_fields})

    def _expect_after(self, stamp: Stamp) -> None:
        self._expected = stamp.sequence + 1
        self._sent_ns = stamp.sent_ns

    def _gap(self, stamp: Stamp) -> None:
        gap = stamp.sequence - self._expected
        self.lost += gap
        if len(self._missing) + gap <= _REMEMBERED:
            self._missing.update(range(self._expected, stamp.sequence))
        self._expect_after(stamp)

    def _from_before(self, stamp: Stamp) -> None:
        """Count a number lower than expected: from a restarted sender, late, or a duplicate."""
        if stamp.sent_ns > self._sent_ns:
            self.restarts += 1
            self.missed_before_start += stamp.sequence
            self._missing.clear()
            self._expect_after(stamp)
        elif stamp.sequence in self._missing:
            self._missing.discard(stamp.sequence)
            self.lost -= 1
            self.late += 1
        else:
            self.duplicates += 1
