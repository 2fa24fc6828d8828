"""Publishes record batches: all that is to be recorded of a match, the messages of several ticks in one.

A robot sends its commands once and forgets them. Noted here they can be fetched again from the host's cache, whatever
program the robot is, and a recording has exactly what the host took in.
"""

from schemas.bus.contract import Bus, Publisher, ReceivedMessage, Stamp
from schemas.messages.record_batch import RawEntry, encode_batch, payload_fields
from schemas.topic import Topic
from schemas.topics import RECORD_BATCH

_MAX_TICKS = 8
"""After which a batch is sent: of five a side it fits into one of Zenoh's batches, 64 KiB."""
_MAX_AGE_S = 0.15
"""Wall time after which it is sent where ticks take longer: a recorder has it half a second later on its disk."""
_MAX_PAYLOADS = 1000
"""Payloads of one tick from others that are noted; a flood is not. What is left out shows as a gap in its sender's
numbers."""
_MAX_PAYLOAD_BYTES = 65_536
"""Bytes of a payload from others that is noted: no longer one is a valid message."""
_MAX_BATCH_BYTES = 256 * 1024
"""Bytes after which a batch is sent at once."""


class BatchPublisher:
    """Collects what is said, and sends it now and then."""

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._clock = bus.clock
        self._writer = bus.publisher(RECORD_BATCH)
        self._entries: list[RawEntry] = []
        self._count = self._size = self._ticks = 0
        self._tick = 0
        self._sent_at = self._clock.now()

    def publisher(self, topic: Topic, **chunks: str) -> Publisher:
        """A writer of the host's, whose messages are noted if the topic is recorded."""
        writer = self._bus.publisher(topic, **chunks)
        return _BatchedPublisher(writer, self) if topic.recorded else writer

    def add_received(self, received: ReceivedMessage) -> None:
        """Somebody else said something that is to be recorded."""
        payload = received.payload
        if self._count >= _MAX_PAYLOADS or len(payload) > _MAX_PAYLOAD_BYTES:
            return
        self._count += 1
        numbers = {} if received.stamp is None else received.stamp._asdict()
        entry = RawEntry(received.key, arrived_ns=received.arrived_ns, **payload_fields(payload), **numbers)
        self.add(entry, len(payload))

    def add(self, entry: RawEntry, size: int) -> None:
        """Something is to be recorded, of so many bytes."""
        self._entries.append(entry)
        self._size += size
        if self._size > _MAX_BATCH_BYTES:
            self.send()

    def end_tick(self, tick: int) -> None:
        """All of this tick has been said and noted; what is noted from now on is of the next."""
        self._tick = tick
        self._ticks += 1
        self._count = 0
        if self._ticks >= _MAX_TICKS:
            self.send()
        else:
            self.send_if_due()

    def send_if_due(self) -> None:
        """Send what was noted, if that is a while ago."""
        if self._entries and self._clock.now() - self._sent_at >= _MAX_AGE_S:
            self.send()

    def send(self) -> None:
        """Send what was noted, be it nothing: a recorder hears how far the host is."""
        self._writer.put_payload(encode_batch(self._tick, self._entries))
        self._entries = []
        self._size = self._ticks = 0
        self._sent_at = self._clock.now()


class _BatchedPublisher(Publisher):
    """A publisher whose messages go into the record batches, too."""

    def __init__(self, writer: Publisher, batches: BatchPublisher) -> None:
        super().__init__(writer.topic, writer.key)
        self._writer, self._batches = writer, batches

    def put_payload(self, payload: bytes) -> Stamp:
        stamp = self._writer.put_payload(payload)
        self._batches.add(RawEntry(self.key, **payload_fields(payload), **stamp._asdict()), len(payload))
        return stamp

    def has_subscribers(self) -> bool:
        return self._writer.has_subscribers()
