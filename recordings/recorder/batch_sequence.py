"""Sorts a host's batches by their numbers, and finds the missing ones. Uses no bus."""

from collections import deque
from collections.abc import Iterable
from typing import NamedTuple

from schemas.messages.record_batch import RecordBatch


class MissingBatches(NamedTuple):
    """Batches to request from the host, from `first` to `last`, both included."""

    stream: int
    first: int
    last: int
    since_ns: int
    """Batches that the host published before this wall time, in ns since 1970, are not requested."""


class BatchSequence:
    """The batches of one host, and of the host that follows it."""

    def __init__(self, since_ns: int) -> None:
        """Batches before the first received one are only missing if published after `since_ns` (wall time)."""
        self.since_ns = since_ns
        self.ready: deque[RecordBatch] = deque()
        """Batches in order, to be removed from the left."""
        self.lost = 0
        """Batches that were given up."""
        self.stream: int | None = None
        """The stream of the host whose batches are read; None before the first batch."""
        self.expected = 0
        """Number of the next batch."""
        self._first = 0
        """Number of the first received batch of this host: missing ones before it may be older than `since_ns`."""
        self._held: dict[int, RecordBatch | None] = {}
        """Batches behind a gap; None for one that cannot be read."""

    def add(self, batch: RecordBatch) -> None:
        """Add a received batch."""
        if batch.stream != self.stream:
            self._follow(batch)
        if batch.number >= self.expected:
            self._held[batch.number] = batch
            self._advance()

    def missing(self) -> MissingBatches | None:
        """The first gap, or None."""
        if not self._held or self.stream is None:
            return None
        since_ns = self.since_ns if self.expected < self._first else 0
        return MissingBatches(self.stream, self.expected, min(self._held) - 1, since_ns)

    def add_requested(self, batches: Iterable[tuple[int, RecordBatch | None]], oldest: int) -> None:
        """Add requested batches: number, and batch, or None if it is not valid.

        The host keeps none with a number below `oldest`: missing ones there are given up.
        """
        for number, batch in batches:
            if number >= self.expected:
                self._held.setdefault(number, batch)
        self._advance()
        if self.expected < oldest and self._held:
            self._skip_to(min(oldest, min(self._held)))

    def skip_missing(self) -> None:
        """Give up all missing batches."""
        while self._held:
            self._skip_to(min(self._held))

    def _follow(self, batch: RecordBatch) -> None:
        self.skip_missing()
        self.stream, self._first = batch.stream, batch.number
        self.expected = 0 if batch.sent_ns >= self.since_ns else batch.number

    def _skip_to(self, number: int) -> None:
        self.lost += max(0, number - max(self.expected, self._first))
        self.expected = number
        self._advance()

    def _advance(self) -> None:
        held = self._held
        while self.expected in held:
            batch = held.pop(self.expected)
            self.expected += 1
            if batch is None:
                self.lost += 1
            else:
                self.ready.append(batch)
