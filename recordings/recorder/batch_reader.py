"""Reads all batches of a host from the bus, in order; what went missing on the way is asked for until it is there."""

from collections import deque
from collections.abc import Iterator

from recordings.recorder.batch_sequence import BatchSequence
from schemas.bus.contract import Bus, NoReplyError, PendingReply
from schemas.messages.record_batch import Batch, RecordBatchesRequest, read_batch, read_reply
from schemas.process.active_clock import ActiveClock
from schemas.topics import RECORD_BATCH, RECORD_BATCHES
from schemas.wire.message import BadMessageError

ANSWER_S = 1.0
"""Wall time after which a question that was not answered is asked again."""
ASK_AGAIN_S = 0.2
"""Wall time after an answer that brought nothing."""
QUIET_S = 0.5
"""Wall time without a batch after which the host is asked for newer ones: the last may have been lost."""
GIVE_UP_S = 20.0
"""Wall time without progress after which missing batches are given up: longer than any link takes that comes back."""


class BatchReader:
    """Listens from the moment it is made. All times but those of sending leave out what the process was suspended."""

    def __init__(self, bus: Bus, since_ns: int | None = None) -> None:
        """Batches published before `since_ns`, the host's wall time, are not read; by default before now."""
        self._bus = bus
        self._sequence = BatchSequence(bus.clock.unix_ns() if since_ns is None else since_ns)
        self._subscription = bus.subscribe(RECORD_BATCH)
        self._active = ActiveClock(bus.clock.now())
        self._pending: PendingReply | None = None
        self._asked_stream: int | None = None
        self._asked_first = 0
        self._asked_at = self._came_at = self._progress_at = self._ask_at = 0.0
        self.unreadable = 0
        """Payloads that were no batch, or no answer."""

    @property
    def is_complete(self) -> bool:
        """Whether nothing is known to be missing."""
        return self._sequence.missing() is None

    @property
    def lost(self) -> int:
        """Batches that are missing for good."""
        return self._sequence.lost

    def read(self) -> Iterator[Batch]:
        """The batches whose turn has come; what is missing is asked for on the way."""
        now = self._active.look(self._bus.clock.now())
        expected = self._sequence.expected
        for received in iter(self._subscription.receive, None):
            self._came_at = now
            batch = self._batch(received.payload)
            if batch is not None:
                self._sequence.take(batch)
        self._process_reply(now)
        if self.is_complete or self._sequence.expected != expected:
            self._progress_at = now
        elif now - self._progress_at >= GIVE_UP_S:
            self._sequence.skip_missing()
        self._request_missing(now)
        return self._ready()

    def skip_missing(self) -> Iterator[Batch]:
        """What has come, without waiting for what is missing."""
        self._sequence.skip_missing()
        return self._ready()

    def _ready(self) -> Iterator[Batch]:
        ready: deque[Batch] = self._sequence.ready
        while ready:
            yield ready.popleft()

    def _request_missing(self, now: float) -> None:
        """Ask for the first gap, or, where none is known and nothing comes, for what is newer."""
        if self._pending is not None or now < self._ask_at:
            return
        sequence = self._sequence
        missing = sequence.missing()
        if missing is not None:
            request = RecordBatchesRequest(first=missing.first, last=missing.last, since_ns=missing.since_ns)
            self._request(missing.stream, request, now)
        elif now - max(self._came_at, self._asked_at) >= QUIET_S and self._bus.connected():
            since_ns = sequence.since_ns if sequence.stream is None else 0
            self._request(sequence.stream, RecordBatchesRequest(first=sequence.expected, since_ns=since_ns), now)

    def _request(self, stream: int | None, request: RecordBatchesRequest, now: float) -> None:
        self._asked_stream, self._asked_first, self._asked_at = stream, request.first, now
        self._pending = self._bus.query(RECORD_BATCHES, request, ANSWER_S, droppable=True)

    def _process_reply(self, now: float) -> None:
        if self._pending is None:
            return
        try:
            payload = self._pending.payload(0.0)
        except NoReplyError:
            if now - self._asked_at >= ANSWER_S:
                self._pending = None
            return
        self._pending = None
        before = self._sequence.expected
        self._add_reply(payload)
        self._ask_at = now if self._sequence.expected > before else now + ASK_AGAIN_S

    def _add_reply(self, payload: bytes) -> None:
        try:
            reply = read_reply(payload)
        except BadMessageError:
            self.unreadable += 1
            return
        first, sequence = max(self._asked_first, reply.oldest), self._sequence
        batches = [(first + place, self._batch(bytes(raw))) for place, raw in enumerate(reply.batches)]
        if reply.stream == sequence.stream:
            sequence.take_again(batches, reply.oldest)
        elif reply.stream != self._asked_stream:  # of a host that has come meanwhile, not one that has gone
            for _, batch in batches:
                if batch is not None:
                    sequence.take(batch)

    def _batch(self, payload: bytes) -> Batch | None:
        try:
            return read_batch(payload)
        except BadMessageError:
            self.unreadable += 1
            return None
