"""Reads the batches of a host from the bus, in order.

Missing batches are requested until they arrive, until the host no longer keeps them, or until `GIVE_UP_S` have passed
without progress.
"""

from collections import deque
from collections.abc import Iterator

from recordings.recorder.batch_sequence import BatchSequence
from schemas.bus.contract import Bus, NoReplyError, PendingReply
from schemas.messages.record_batch import RecordBatch, RecordBatchesReply, RecordBatchesRequest
from schemas.process.active_clock import ActiveClock
from schemas.process.timing import GIVE_UP_S
from schemas.topics import RECORD_BATCH, RECORD_BATCHES
from schemas.wire.message import BadMessageError

REPLY_S = 1.0
"""Wall time after which a request without a reply is repeated."""
REPEAT_S = 0.2
"""Wall time between a reply without a missing batch and the next request."""
QUIET_S = 0.5
"""Wall time without a batch after which newer ones are requested: the last batch may have been lost."""


class BatchReader:
    """Subscribes when it is constructed. Wall time in which the process was suspended does not count."""

    def __init__(self, bus: Bus, since_ns: int | None = None) -> None:
        """Batches published before `since_ns`, the host's wall time, are not read; by default before now."""
        self._bus = bus
        self._sequence = BatchSequence(bus.clock.unix_ns() if since_ns is None else since_ns)
        self._subscription = bus.subscribe(RECORD_BATCH)
        self._active = ActiveClock(bus.clock.now())
        self._pending: PendingReply | None = None
        self._requested_stream: int | None = None
        self._requested_first = 0
        self._requested_at = self._received_at = self._progress_at = self._next_request_at = 0.0
        self.unreadable = 0
        """Payloads that were not a valid batch or reply."""

    @property
    def is_complete(self) -> bool:
        """Whether nothing is known to be missing."""
        return self._sequence.missing() is None

    @property
    def lost(self) -> int:
        """Batches that were given up."""
        return self._sequence.lost

    def read(self) -> Iterator[RecordBatch]:
        """The batches that can be read in order now; missing ones are requested."""
        now = self._active.look(self._bus.clock.now())
        expected = self._sequence.expected
        for received in iter(self._subscription.receive, None):
            self._received_at = now
            batch = self._batch(received.payload)
            if batch is not None:
                self._sequence.add(batch)
        self._process_reply(now)
        if self.is_complete or self._sequence.expected != expected:
            self._progress_at = now
        elif now - self._progress_at >= GIVE_UP_S:
            self._sequence.skip_missing()
        self._request_missing(now)
        return self._ready()

    def skip_missing(self) -> Iterator[RecordBatch]:
        """The received batches, without waiting for missing ones."""
        self._sequence.skip_missing()
        return self._ready()

    def _ready(self) -> Iterator[RecordBatch]:
        ready: deque[RecordBatch] = self._sequence.ready
        while ready:
            yield ready.popleft()

    def _request_missing(self, now: float) -> None:
        """Request the batches of the first gap, or, if none is known and no batch arrives, newer batches."""
        if self._pending is not None or now < self._next_request_at:
            return
        sequence = self._sequence
        missing = sequence.missing()
        if missing is not None:
            request = RecordBatchesRequest(first=missing.first, last=missing.last, since_ns=missing.since_ns)
            self._request(missing.stream, request, now)
        elif now - max(self._received_at, self._requested_at) >= QUIET_S and self._bus.connected():
            since_ns = sequence.since_ns if sequence.stream is None else 0
            self._request(sequence.stream, RecordBatchesRequest(first=sequence.expected, since_ns=since_ns), now)

    def _request(self, stream: int | None, request: RecordBatchesRequest, now: float) -> None:
        self._requested_stream, self._requested_first, self._requested_at = stream, request.first, now
        self._pending = self._bus.query(RECORD_BATCHES, request, REPLY_S, droppable=True)

    def _process_reply(self, now: float) -> None:
        if self._pending is None:
            return
        try:
            payload = self._pending.payload(0.0)
        except NoReplyError:
            if now - self._requested_at >= REPLY_S:
                self._pending = None
            return
        self._pending = None
        before = self._sequence.expected
        self._add_reply(payload)
        self._next_request_at = now if self._sequence.expected > before else now + REPEAT_S

    def _add_reply(self, payload: bytes) -> None:
        try:
            reply = RecordBatchesReply.decode(payload)
        except BadMessageError:
            self.unreadable += 1
            return
        first, sequence = max(self._requested_first, reply.oldest), self._sequence
        batches = [(first + place, self._batch(bytes(raw))) for place, raw in enumerate(reply.batches)]
        if reply.stream == sequence.stream:
            sequence.add_requested(batches, reply.oldest)
        elif reply.stream != self._requested_stream:  # of a host that has joined since, not of one that has left
            for _, batch in batches:
                if batch is not None:
                    sequence.add(batch)

    def _batch(self, payload: bytes) -> RecordBatch | None:
        try:
            return RecordBatch.decode(payload)
        except BadMessageError:
            self.unreadable += 1
            return None
