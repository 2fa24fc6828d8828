"""Messages over Zenoh: who writes a key, and who reads a topic."""

from typing import Any

import zenoh
from zenoh import ext

from schemas.bus.contract import BusError, Publisher, Received, Stamp
from schemas.bus.mending import Mender
from schemas.bus.session import Seat, first_line
from schemas.bus.zenoh_mending import ZenohMending
from schemas.bus.zenoh_reader import ZenohReader
from schemas.bus.zenoh_sample import STAMP, is_poke, message_in
from schemas.topic import Delivery, Topic
from schemas.topics import TOPICS

_BACKLOG = 500_000
"""Samples that may wait for a reader who takes every one."""
_LITERAL_KEYS = frozenset(topic.key for topic in TOPICS.values() if not topic.chunks)


class ZenohPublisher(Publisher):
    def __init__(self, topic: Topic, key: str, seat: Seat) -> None:
        super().__init__(topic, key)
        self._clock = seat.clock
        self._sequence = 0
        full = seat.prefix + key
        quiet: dict[str, Any] = {
            "encoding": zenoh.Encoding.APPLICATION_JSON,
            "congestion_control": zenoh.CongestionControl.DROP,
        }
        self._writer: Any
        if topic.delivery is Delivery.RECOVERED:
            self._writer = ext.declare_advanced_publisher(
                seat.session,
                full,
                cache=ext.CacheConfig(max_samples=topic.kept),
                sample_miss_detection=ext.MissDetectionConfig(heartbeat=0.5, sporadic_heartbeat=None),
                publisher_detection=True,
                **quiet,
            )
        else:
            self._writer = seat.session.declare_publisher(full, **quiet)

    def put_payload(self, payload: bytes) -> Stamp:
        clock = self._clock
        stamp = Stamp(self._sequence, clock.unix_ns(), clock.sim_ns)
        try:
            self._writer.put(payload, attachment=STAMP.pack(*stamp))
        except zenoh.ZError as error:
            raise BusError(f"this bus is closed ({first_line(error)})") from None
        self._sequence += 1
        return stamp

    def wanted(self) -> bool:
        if self.topic.delivery is Delivery.RECOVERED:
            return True  # Zenoh does not tell for writers with a cache, and the cache wants all samples anyway
        return bool(self._writer.matching_status.matching)


class ZenohSubscription(ZenohReader):
    """The messages of a topic, of one key or of several: every one, or the newest of each."""

    def __init__(self, topic: Topic, key: str, seat: Seat, newest: bool, past: bool) -> None:
        super().__init__(topic, key, seat)
        self._start = len(seat.prefix)
        self._newest = newest
        self._kept: dict[str, Received] = {}
        self._mending: ZenohMending | None = None
        born_ns = seat.clock.unix_ns()
        every: Any = zenoh.handlers.FifoChannel(_BACKLOG)
        if topic.delivery is Delivery.RECOVERED and not newest:
            recovery = ext.RecoveryConfig(heartbeat=True, periodic_queries=None)
            history = ext.HistoryConfig(detect_late_publishers=True, max_samples=topic.kept) if past else None
            self._reader = ext.declare_advanced_subscriber(
                seat.session, self._full_key, every, history=history, recovery=recovery
            )
            mender = Mender(since_ns=0, reach=topic.kept) if past else Mender(since_ns=born_ns)
            self._mending = ZenohMending(seat, mender, self._read, self.poke)
        else:
            self._reader = seat.session.declare_subscriber(self._full_key, every)

    def receive(self, timeout: float | None = 0.0) -> Received | None:
        if self._newest:
            return self._receive_newest(timeout)
        return self._next(timeout)

    def _receive_newest(self, timeout: float | None) -> Received | None:
        """The newest of a key, with all that wait taken in first."""
        kept = self._kept
        received = self._next(0.0 if kept else timeout)
        while received is not None:
            kept.pop(received.key, None)
            kept[received.key] = received
            received = self._next(0.0)
        return kept.pop(next(iter(kept))) if kept else None

    def forgo(self) -> None:
        if self._mending is not None:
            self._mending.forgo()

    def _next(self, timeout: float | None) -> Received | None:
        """The next message of this topic; a poke ends the waiting when its time has come, or mending has news."""
        reader, mending, until = self._reader, self._mending, self._until(timeout)
        try:
            while True:
                received = mending.next() if mending is not None else None
                if received is not None:
                    return received
                sample = reader.try_recv()
                if sample is None:
                    if self._ended or self._clock.now() >= until:
                        return None
                    sample = self._wait(until if mending is None else min(until, mending.due_at()))
                received = self._read(sample)
                if received is None or mending is None or mending.passes(received):
                    if received is not None:
                        return received
                else:
                    mending.take(received, sample)
        except zenoh.ZError:
            return None  # the session was closed meanwhile

    def _read(self, sample: zenoh.Sample) -> Received | None:
        """The message in a sample; nothing in a poke, and in one of another topic."""
        payload = sample.payload.to_bytes()
        key = str(sample.key_expr)[self._start :]
        if (not payload and is_poke(sample)) or (key in _LITERAL_KEYS and key != self._topic.key):
            return None
        return message_in(sample, self._topic, key, payload, self._timed)
