"""Publishes the messages to be recorded of a match in batches of several ticks, and keeps the newest batches.

A robot publishes its commands once and keeps none. In a batch, they can be requested from the host again, whatever
program the robot runs, and a recording has exactly the messages that the host received.
"""

from collections import deque
from collections.abc import Callable
from itertools import islice
from typing import NamedTuple, Protocol

from msgspec import Raw

from runtime.bus.contract import Bus, Publisher, ReceivedMessage, Stamp
from runtime.process.large_blocks import mapped
from schemas.messages.record_batch import BatchEntry, RecordBatch, RecordBatchesReply, RecordBatchesRequest
from schemas.recovery_window import BATCH_S, BATCH_TICKS, KEPT_BATCHES, KEPT_BYTES
from schemas.topic import Topic
from schemas.topics import RECORD_BATCH, RECORD_BATCHES
from schemas.wire.message import BadMessageError

_MAX_PAYLOADS_PER_TICK = 1000
"""Most payloads of other processes that are recorded in one tick, as protection from a flood. Those beyond it show as a
gap in their sender's sequence numbers."""
_MAX_PAYLOAD_BYTES = 65_536
"""Most bytes of a payload of another process that is recorded: longer payloads are not valid messages."""
_FULL_BATCH_BYTES = 256 * 1024
"""Bytes at which a batch is published at once."""
_MAX_REPLY_BYTES = 512 * 1024
"""Most bytes of the batches in a reply with more than one batch: small enough to fit on a busy link soon."""
_MAX_REPLIES_PER_TICK = 4
"""Most replies between two ticks, so that recorders with many requests do not delay the host."""
_NO_STAMP = (None, 0, -1)
"""In place of the stamp of a message that has none."""


class RecordedPublishers(Protocol):
    """What a host publishes with: what is recorded of it is recorded in the order of publishing."""

    def publisher(self, topic: Topic, **chunks: str) -> Publisher:
        """A publisher of the host whose messages are recorded where the topic is."""

    def add_own(self, key: str, payload: bytes, stamp: Stamp) -> None:
        """Record a message that was published on a key that is not recorded always."""


class _Kept(NamedTuple):
    sent_ns: int
    payload: memoryview


class BatchPublisher:
    """Collects messages, publishes them in batches, and serves requests for earlier batches."""

    def __init__(self, bus: Bus, note_invalid: Callable[[str, str, bytes], None] = lambda *_: None) -> None:
        """`note_invalid` is called with key, reason and payload of an invalid request."""
        self._bus = bus
        self._clock = bus.clock
        self._note_invalid = note_invalid
        self._writer = bus.publisher(RECORD_BATCH)
        self._requests = bus.serve(RECORD_BATCHES)
        self._stream = self._clock.unix_ns()
        self._entries: list[BatchEntry] = []
        self._count = self._size = self._ticks = 0
        self._tick = -1
        self._sent_at = self._clock.now()
        self._kept: deque[_Kept] = deque()
        self._kept_bytes = self._next = 0

    def publisher(self, topic: Topic, **chunks: str) -> Publisher:
        """A publisher of the host whose messages are recorded where the topic is."""
        return self.recorded_publisher(topic, **chunks) if topic.recorded else self._bus.publisher(topic, **chunks)

    def recorded_publisher(self, topic: Topic, **chunks: str) -> Publisher:
        """A publisher whose messages are recorded in any case."""
        return _Recorded(self._bus.publisher(topic, **chunks), self)

    def add_received(self, received: ReceivedMessage) -> None:
        """Add a message of another process."""
        payload = received.payload
        if self._count >= _MAX_PAYLOADS_PER_TICK or len(payload) > _MAX_PAYLOAD_BYTES:
            return
        self._count += 1
        stamp = received.stamp or _NO_STAMP
        self._enter(BatchEntry.of(received.key, payload, *stamp, received.arrived_ns, self._clock.sim_ns), len(payload))

    def add_own(self, key: str, payload: bytes, stamp: Stamp) -> None:
        """Add a message that the host has published."""
        self._enter(BatchEntry.of(key, payload, *stamp), len(payload))

    def end_tick(self, tick: int) -> None:
        """End a tick: later messages belong to the next one."""
        self._tick = tick
        self._ticks += 1
        self._count = 0
        if self._ticks >= BATCH_TICKS:
            self.send()
        else:
            self.send_if_due()

    def send_if_due(self) -> None:
        """Publish the collected messages where `BATCH_S` has passed since the last batch."""
        if self._entries and self._clock.now() - self._sent_at >= BATCH_S:
            self.send()

    def send(self) -> None:
        """Publish the collected messages; an empty batch reports the host's progress to recorders."""
        sent_ns = self._clock.unix_ns()
        batch = RecordBatch(
            stream=self._stream, number=self._next, tick=self._tick, sent_ns=sent_ns, entries=self._entries
        )
        payload = batch.encode()
        self._next += 1
        self._writer.put_payload(payload)
        self._keep(_Kept(sent_ns, mapped(payload)))
        self._entries = []
        self._size = self._ticks = 0
        self._sent_at = self._clock.now()

    def process(self) -> None:
        """Reply to requests for earlier batches."""
        for query in islice(iter(self._requests.receive, None), _MAX_REPLIES_PER_TICK):
            try:
                request: RecordBatchesRequest = query.message()
            except BadMessageError as error:
                self._note_invalid(query.key, str(error), query.payload)
                query.fail(str(error))
            else:
                query.reply(self._reply(request))

    def _enter(self, entry: BatchEntry, size: int) -> None:
        self._entries.append(entry)
        self._size += size
        if self._size > _FULL_BATCH_BYTES:
            self.send()

    def _keep(self, kept: _Kept) -> None:
        self._kept.append(kept)
        self._kept_bytes += len(kept.payload)
        while len(self._kept) > KEPT_BATCHES or (self._kept_bytes > KEPT_BYTES and len(self._kept) > 1):
            self._kept_bytes -= len(self._kept.popleft().payload)

    def _reply(self, request: RecordBatchesRequest) -> RecordBatchesReply:
        oldest = self._next - sum(kept.sent_ns >= request.since_ns for kept in self._kept)
        start = min(max(request.first, oldest), self._next)
        end = self._next if request.last is None else min(self._next, request.last + 1)
        batches: list[Raw] = []
        size = 0
        for kept in islice(self._kept, start - self._next + len(self._kept), None):
            size += len(kept.payload)
            if start + len(batches) >= end or (batches and size > _MAX_REPLY_BYTES):
                break
            batches.append(Raw(kept.payload))
        return RecordBatchesReply(stream=self._stream, oldest=oldest, batches=batches)


class _Recorded(Publisher):
    """A publisher whose messages are also recorded."""

    def __init__(self, writer: Publisher, batches: BatchPublisher) -> None:
        super().__init__(writer.topic, writer.key)
        self._writer, self._batches = writer, batches

    def put_payload(self, payload: bytes) -> Stamp:
        stamp = self._writer.put_payload(payload)
        self._batches.add_own(self.key, payload, stamp)
        return stamp

    def put_copy(self, payload: bytes, stamp: Stamp) -> None:
        self._writer.put_copy(payload, stamp)
        self._batches.add_own(self.key, payload, stamp)

    def has_subscribers(self) -> bool:
        return self._writer.has_subscribers()
