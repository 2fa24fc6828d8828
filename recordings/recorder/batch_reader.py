"""Reads the batches of a host from the bus, in order, and the messages in them.

Missing batches are requested until they arrive, until the host no longer keeps them, or until `GIVE_UP_S` have passed
without progress.
"""

from collections import deque
from collections.abc import Iterable, Iterator

from recordings.recorder.recording_writer import LoggedMessage
from recordings.timing import QUIET_S, REPEAT_S
from runtime.bus.contract import Bus, NoReplyError, PendingReply, ReceivedMessage, Stamp
from runtime.process.active_clock import ActiveClock
from runtime.process.timing import GIVE_UP_S, REPLY_S
from schemas.messages.record_batch import BatchEntry, RecordBatch, RecordBatchesReply, RecordBatchesRequest
from schemas.recovery_window import KEPT_BATCHES
from schemas.topic import Party
from schemas.topics import RECORD_BATCH, RECORD_BATCHES, SIGHT, recorded_topic
from schemas.wire.message import BadMessageError, valid

_FEWER = 8
"""A reply of 512 KiB has some 30 batches: the third request, after two seconds, is for a few."""


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

    def missing(self) -> RecordBatchesRequest | None:
        """The request for the first gap, or None."""
        if not self._held:
            return None
        since_ns = self.since_ns if self.expected < self._first else 0
        return RecordBatchesRequest(first=self.expected, last=min(self._held) - 1, since_ns=since_ns)

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


class BatchReader:
    """Subscribes when it is constructed. Wall time in which the process was suspended does not count."""

    def __init__(self, bus: Bus, since_ns: int | None = None) -> None:
        """Batches published before `since_ns`, the host's wall time, are not read; by default before now."""
        self._bus = bus
        self._sequence = BatchSequence(bus.clock.unix_ns() if since_ns is None else since_ns)
        self._subscription = bus.subscribe(RECORD_BATCH)
        self._active = ActiveClock(bus.clock.now())
        self._pending: PendingReply | None = None
        self._most = KEPT_BATCHES
        """Batches of a gap that are requested at a time: fewer after a reply that did not arrive, since a long one is
        dropped first where the receiver is busy."""
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
            self._request(missing, now)
        elif now - max(self._received_at, self._requested_at) >= QUIET_S and self._bus.connected():
            since_ns = sequence.since_ns if sequence.stream is None else 0
            self._request(RecordBatchesRequest(first=sequence.expected, since_ns=since_ns), now)

    def _request(self, request: RecordBatchesRequest, now: float) -> None:
        if request.last is not None:
            request = request.replace(last=min(request.last, request.first + self._most - 1))
        self._requested_stream, self._requested_first = self._sequence.stream, request.first
        self._requested_at = now
        self._pending = self._bus.query(RECORD_BATCHES, request, REPLY_S, droppable=True)

    def _process_reply(self, now: float) -> None:
        if self._pending is None:
            return
        try:
            payload = self._pending.payload(0.0)
        except NoReplyError:
            if now - self._requested_at >= REPLY_S:
                self._pending = None
                self._most = max(1, self._most // _FEWER)
            return
        self._pending = None
        self._most = min(2 * self._most, KEPT_BATCHES)
        before = self._sequence.expected
        self._add_reply(payload)
        self._next_request_at = now if self._sequence.expected > before else now + REPEAT_S

    def _add_reply(self, payload: bytes) -> None:
        reply = valid(RecordBatchesReply.decode, payload)
        if reply is None:
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
        batch: RecordBatch | None = valid(RecordBatch.decode, payload)
        self.unreadable += batch is None
        return batch


class Unbatcher:
    """Extracts the messages of batches, in order.

    The log time of a message is the host's simulated time when it published or received the message; it never runs
    backward.
    """

    def __init__(self, *, sights: bool = False, begins_ns: int = 0) -> None:
        """Without `sights`, sights are skipped. Messages before the log time `begins_ns` are skipped, too."""
        self._sights, self._begins_ns = sights, begins_ns
        self._log_ns = 0

    def messages_of(self, batch: RecordBatch) -> list[LoggedMessage]:
        """The messages of a batch, in order; keys of no recorded topic are skipped.

        Raises:
            BadMessageError: an entry cannot be read.
        """
        found = []
        log_ns, sights = self._log_ns, self._sights
        for entry in batch.entries:
            key, number = entry.key, entry.sequence
            topic = recorded_topic(key)
            if topic is None or (topic is SIGHT and not sights):
                continue
            moment = entry.sim_ns if topic.writer is Party.HOST else entry.arrived_sim_ns
            if moment > log_ns:
                log_ns = moment
            if log_ns < self._begins_ns:
                continue
            payload = bytes(entry.message) if entry.octets is None else _octets(entry)
            stamp = Stamp(number, entry.sent_ns, entry.sim_ns) if number is not None else None
            found.append((log_ns, ReceivedMessage(topic, key, payload, stamp, entry.arrived_ns)))
        self._log_ns = log_ns
        return found


def _octets(entry: BatchEntry) -> bytes:
    try:
        return entry.payload
    except ValueError as error:
        raise BadMessageError(f"RecordBatch: octets of {entry.key}: {error}") from None
