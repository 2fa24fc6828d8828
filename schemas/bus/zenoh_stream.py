"""Messages over Zenoh: who writes a key, and who reads a topic."""

import struct
from typing import Any

import zenoh
from zenoh import ext

from schemas.bus.contract import BusError, Publisher, Received, Stamp, Subscription
from schemas.bus.mending import Mender
from schemas.bus.session import Seat, first_line
from schemas.bus.zenoh_mending import ZenohMending
from schemas.topic import Delivery, Topic
from schemas.topics import TOPICS

_CACHE = 1500
"""Samples a writer keeps for recovery, per key: 30 s of ticks in real time."""
STAMP = struct.Struct("<QQq")
"""What travels beside each message: its number, the writer's wall time in ns and simulated time in ns."""
_BACKLOG = 500_000
"""Samples that may wait for a reader who takes every one."""
_POKE = "-"
"""Marks a sample that only ends a wait; stands for the chunks of its key, where no name can be this."""
_POKE_MARK = _POKE.encode()
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
                cache=ext.CacheConfig(max_samples=_CACHE),
                sample_miss_detection=ext.MissDetectionConfig(heartbeat=0.5, sporadic_heartbeat=None),
                publisher_detection=True,
                **quiet,
            )
        else:
            self._writer = seat.session.declare_publisher(full, **quiet)

    def put_payload(self, payload: bytes) -> None:
        clock = self._clock
        try:
            self._writer.put(payload, attachment=STAMP.pack(self._sequence, clock.unix_ns(), clock.sim_ns))
        except zenoh.ZError as error:
            raise BusError(f"this bus is closed ({first_line(error)})") from None
        self._sequence += 1

    def wanted(self) -> bool:
        if self.topic.delivery is Delivery.RECOVERED:
            return True  # Zenoh does not tell for writers with a cache, and the cache wants all samples anyway
        return bool(self._writer.matching_status.matching)


class ZenohSubscription(Subscription):
    """Samples wait in a channel of Zenoh's own, filled without Python: neither side ever waits for the other's GIL.

    A channel can be waited on only without end, so a wait that has one is ended by a poke: a sample that the bus's
    alarm puts on this reader's own key, heard by nobody else.
    """

    def __init__(self, topic: Topic, key: str, seat: Seat, newest: bool, past: bool) -> None:
        self._topic = topic
        self._seat = seat
        self._start = len(seat.prefix)
        self._newest = newest or topic.delivery is Delivery.NEWEST
        self._timed = not seat.is_client
        self._waits = False
        self._waits_until: float | None = None
        self._ended = False
        self._kept: dict[str, Received] = {}
        self._mending: ZenohMending | None = None
        full = seat.prefix + key
        self._poke_key = full.replace("*", _POKE)
        born_ns = seat.clock.unix_ns()
        self._reader: Any
        if topic.delivery is Delivery.RECOVERED and not self._newest:
            recovery = ext.RecoveryConfig(heartbeat=True, periodic_queries=None)
            history = ext.HistoryConfig(detect_late_publishers=True, max_samples=_CACHE) if past else None
            every: Any = zenoh.handlers.FifoChannel(_BACKLOG)
            self._reader = ext.declare_advanced_subscriber(
                seat.session, full, every, history=history, recovery=recovery
            )
            mender = Mender(since_ns=0, reach=_CACHE) if past else Mender(since_ns=born_ns)
            self._mending = ZenohMending(seat, mender, self._read, self.poke)
        else:
            # one place beside the newest, so that a poke never pushes it out; a wildcard needs all keys' samples
            ring = self._newest and "*" not in key
            channel: Any = zenoh.handlers.RingChannel(2) if ring else zenoh.handlers.FifoChannel(_BACKLOG)
            self._reader = seat.session.declare_subscriber(full, channel)

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
        reader, mending = self._reader, self._mending
        until = self._seat.clock.now() + timeout if timeout else timeout
        try:
            while True:
                received = mending.next() if mending is not None else None
                if received is not None:
                    return received
                sample = reader.try_recv()
                if sample is None:
                    if self._ended or (until is not None and (until == 0.0 or self._seat.clock.now() >= until)):
                        return None
                    sample = self._wait(until)
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
        attachment = sample.attachment
        raw = attachment.to_bytes() if attachment is not None else b""
        key = str(sample.key_expr)[self._start :]
        if raw == _POKE_MARK or (key in _LITERAL_KEYS and key != self._topic.key):
            return None
        stamp = Stamp(*STAMP.unpack(raw)) if len(raw) == STAMP.size else None
        arrived = _arrival(sample) if self._timed else 0
        return Received(self._topic, key, sample.payload.to_bytes(), stamp, arrived)

    def _wait(self, until: float | None) -> zenoh.Sample:
        """The next sample in the channel, however long it takes."""
        self._waits, self._waits_until = True, until
        if until is not None or self._mending is not None:
            self._seat.alarm.wake()
        try:
            sample: zenoh.Sample = self._reader.recv()
        finally:
            self._waits = False
        return sample

    def poke_if_due(self, now: float) -> None:
        """End a wait that has lasted long enough, or during which something has to be asked for."""
        until, mending = self._waits_until, self._mending
        if self._waits and ((until is not None and now >= until) or (mending is not None and mending.is_due(now))):
            self.poke()

    def poke(self) -> None:
        """End a wait."""
        self._seat.session.put(self._poke_key, b"", attachment=_POKE, allowed_destination=zenoh.Locality.SESSION_LOCAL)

    def end(self) -> None:
        """Wake the reader for good."""
        self._ended = True
        self.poke()

    def close(self) -> None:
        self.end()
        try:
            self._reader.undeclare()
        except zenoh.ZError:
            return  # undeclared already, with its session


def _arrival(sample: zenoh.Sample) -> int:
    """When the host's router stamped the sample: where and when it came in, ns since 1970; 0 when it did not."""
    stamp = sample.timestamp
    return stamp.get_time_as_ntp64().as_nanos() if stamp is not None else 0
