"""Publishers and subscriptions over Zenoh."""

from typing import Any

import zenoh
from zenoh import ext

from runtime.bus.contract import BusError, Publisher, ReceivedMessage, Stamp
from runtime.bus.refusals import NO_KEY
from runtime.bus.zenoh.reader import STAMP, ZenohReader, is_wake_up
from runtime.bus.zenoh.session import SessionContext, first_line
from runtime.process.timing import HEARTBEAT_S
from schemas.topic import Delivery, Topic
from schemas.topics import TOPICS

_BACKLOG = 500_000
"""Most samples that wait for a subscription that reads every one."""
_MAX_KNOWN_KEYS = 1000
"""Keys that are remembered as keys of the topic; others are checked with each message."""
_HOST_BACKLOG = 2048
"""Most samples that wait for a subscription of the host; the oldest are dropped first. A full `FifoChannel` would stop
the link, and the host reads more often than any match fills this."""
_LITERAL_KEYS = frozenset(topic.key for topic in TOPICS.values() if not topic.chunks)


class ZenohPublisher(Publisher):
    def __init__(self, topic: Topic, key: str, context: SessionContext) -> None:
        super().__init__(topic, key)
        self._clock = context.clock
        self._sequence = 0
        full = context.prefix + key
        quiet: dict[str, Any] = {
            "encoding": zenoh.Encoding.APPLICATION_JSON,
            "congestion_control": zenoh.CongestionControl.DROP,
        }
        self._writer: Any
        if topic.delivery is Delivery.RECOVERED:
            self._writer = ext.declare_advanced_publisher(
                context.session,
                full,
                cache=ext.CacheConfig(max_samples=topic.cache_size),
                sample_miss_detection=ext.MissDetectionConfig(heartbeat=HEARTBEAT_S, sporadic_heartbeat=None),
                publisher_detection=True,
                **quiet,
            )
        else:
            self._writer = context.session.declare_publisher(full, **quiet)

    def put_payload(self, payload: bytes) -> Stamp:
        clock = self._clock
        stamp = Stamp(self._sequence, clock.unix_ns(), clock.sim_ns)
        self.put_copy(payload, stamp)
        self._sequence += 1
        return stamp

    def put_copy(self, payload: bytes, stamp: Stamp) -> None:
        try:
            self._writer.put(payload, attachment=STAMP.pack(*stamp))
        except zenoh.ZError as error:
            raise BusError(f"this bus is closed ({first_line(error)})") from None

    def has_subscribers(self) -> bool:
        if self.topic.delivery is Delivery.RECOVERED:
            return True  # Zenoh does not report it for publishers with a cache
        return bool(self._writer.matching_status.matching)


class ZenohSubscription(ZenohReader):
    """The messages of a topic, of one key or of several: every one, or the newest of each."""

    def __init__(self, topic: Topic, key: str, context: SessionContext, newest: bool, history: bool) -> None:
        super().__init__(topic, key, context)
        self._start = len(context.prefix)
        self._newest = newest
        self._kept: dict[str, ReceivedMessage] = {}
        self._known_keys: set[str] = set()
        """Keys of this topic on which messages have arrived."""
        every: Any = (
            zenoh.handlers.FifoChannel(_BACKLOG) if context.is_client else zenoh.handlers.RingChannel(_HOST_BACKLOG)
        )
        if topic.delivery is Delivery.RECOVERED and not newest:
            settings = ext.RecoveryConfig(heartbeat=True, periodic_queries=None)
            past = ext.HistoryConfig(detect_late_publishers=True, max_samples=topic.cache_size) if history else None
            self._reader = ext.declare_advanced_subscriber(
                context.session, self._full_key, every, history=past, recovery=settings
            )
        else:
            self._reader = context.session.declare_subscriber(self._full_key, every)

    def receive(self, timeout: float | None = 0.0) -> ReceivedMessage | None:
        if self._newest:
            return self._receive_newest(timeout)
        return self._next(timeout)

    def _receive_newest(self, timeout: float | None) -> ReceivedMessage | None:
        """The newest message of a key, after all waiting messages are processed."""
        kept = self._kept
        received = self._next(0.0 if kept else timeout)
        while received is not None:
            kept.pop(received.key, None)
            kept[received.key] = received
            received = self._next(0.0)
        return kept.pop(next(iter(kept))) if kept else None

    def _next(self, timeout: float | None) -> ReceivedMessage | None:
        """The next message of this topic; a wake-up ends the wait at its deadline."""
        reader, until = self._reader, self._deadline_of(timeout)
        try:
            while True:
                sample = reader.try_recv()
                if sample is None:
                    if self._ended or self._clock.now() >= until:
                        return None
                    sample = self._wait(until)
                received = self._read(sample)
                if received is not None:
                    return received
        except zenoh.ZError:
            return None  # the session was closed

    def _read(self, sample: zenoh.Sample) -> ReceivedMessage | None:
        """The message in a sample; None for a wake-up, and for a sample on a key that is none of this topic."""
        payload = sample.payload.to_bytes()
        key = str(sample.key_expr)[self._start :]
        if key not in self._known_keys:
            if (not payload and is_wake_up(sample)) or not self._learn(key, len(payload)):
                return None
        elif not payload and is_wake_up(sample):
            return None
        return self._message(sample, key, payload)

    def _learn(self, key: str, size: int) -> bool:
        """Whether a key is one of this topic; others are refused, except those of a topic with a narrower key."""
        if key in _LITERAL_KEYS and key != self._topic.key:
            return False
        if not self._topic.has_key(key):
            self._context.owner.refusals.add(key or "**", NO_KEY, size)
            return False
        if len(self._known_keys) < _MAX_KNOWN_KEYS:
            self._known_keys.add(key)
        return True
