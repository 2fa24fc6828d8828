"""Puts a host's batches into the order of their numbers, and knows which of them are missing. Knows no bus."""

from collections import deque
from collections.abc import Iterable
from typing import NamedTuple

from schemas.messages.record_batch import Batch


class MissingBatches(NamedTuple):
    """Batches to ask the host for, from `first` to `last`, both included."""

    stream: int
    first: int
    last: int
    since_ns: int
    """Those that the host published before this wall time, ns since 1970, are not wanted."""


class BatchSequence:
    """Follows the batches of one host, and of the next one after that."""

    def __init__(self, since_ns: int) -> None:
        """Before the first batch that comes, those published before `since_ns` (wall time) are not missed."""
        self.since_ns = since_ns
        self.ready: deque[Batch] = deque()
        """Batches in their order, to be taken from the left."""
        self.lost = 0
        """Batches that are missing for good."""
        self.stream: int | None = None
        """Which host is followed; None before the first batch."""
        self.expected = 0
        """Number of the next batch."""
        self._first = 0
        """Number of the first batch that came of this host: what is missing before it may be from before `since_ns`."""
        self._held: dict[int, Batch | None] = {}
        """Batches behind a gap; None for one that cannot be read."""

    def take(self, batch: Batch) -> None:
        """A batch has come."""
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

    def take_again(self, batches: Iterable[tuple[int, Batch | None]], oldest: int) -> None:
        """The host has sent batches again: number, and batch or None where it cannot be read.

        It keeps none with a number below `oldest`: what is missing there is missing for good.
        """
        for number, batch in batches:
            if number >= self.expected:
                self._held.setdefault(number, batch)
        self._advance()
        if self.expected < oldest and self._held:
            self._skip_to(min(oldest, min(self._held)))

    def skip_missing(self) -> None:
        """Wait no longer for what is missing."""
        while self._held:
            self._skip_to(min(self._held))

    def _follow(self, batch: Batch) -> None:
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
