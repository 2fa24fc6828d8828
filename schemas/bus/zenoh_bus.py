"""The bus over Zenoh: the host is the router, everyone else a client with one explicit endpoint.

With `session`, which opens what this is built on, the only module that knows Zenoh. Samples wait in channels of Zenoh's
own until they are read.
"""

import struct
import threading
import weakref
from typing import Any

import zenoh
from zenoh import ext

from schemas.bus.contract import (
    Answer,
    Bus,
    BusError,
    NoAnswerError,
    Presence,
    PresenceWatch,
    Publisher,
    Question,
    Received,
    Server,
    Stamp,
    Subscription,
    check_publishable,
    full_key,
)
from schemas.bus.endpoint import DEFAULT_ENDPOINT
from schemas.bus.mailbox import EveryMailbox
from schemas.bus.session import first_line, open_connection, open_router
from schemas.clock import Clock
from schemas.message import Message
from schemas.topic import Delivery, Topic
from schemas.topics import TOPICS, root

_CACHE = 1500
"""Samples a writer keeps for recovery, per key: 30 s of ticks in real time."""
_STAMP = struct.Struct("<QQq")
_BACKLOG = 500_000
"""Samples that may wait for a reader who takes every one."""
_POKE = "-"
"""Marks a sample that only ends a wait; stands for the chunks of its key, where no name can be this."""
_POKE_MARK = _POKE.encode()
_ALARM_S = 0.05
"""Resolution of timeouts."""
_LITERAL_KEYS = frozenset(topic.key for topic in TOPICS.values() if not topic.chunks)


def open_host(match: str, clock: Clock, listen: str = DEFAULT_ENDPOINT) -> "ZenohBus":
    """Open the host's seat: a router that listens on one endpoint.

    Raises:
        BusError: the endpoint cannot be listened on.
    """
    return ZenohBus(match, clock, open_router(listen), is_client=False)


def open_client(match: str, clock: Clock, connect: str = DEFAULT_ENDPOINT, patience: float = 10.0) -> "ZenohBus":
    """Open a client's seat, trying for `patience` s of wall time.

    Raises:
        BusError: no host answers at that endpoint.
    """
    return ZenohBus(match, clock, open_connection(connect, clock, patience), is_client=True)


class _Publisher(Publisher):
    def __init__(self, topic: Topic, key: str, bus: "ZenohBus") -> None:
        super().__init__(topic, key)
        self._clock = bus.clock
        self._sequence = 0
        full = bus.prefix + key
        quiet: dict[str, Any] = {
            "encoding": zenoh.Encoding.APPLICATION_JSON,
            "congestion_control": zenoh.CongestionControl.DROP,
        }
        self._writer: Any
        if topic.delivery is Delivery.RECOVERED:
            self._writer = ext.declare_advanced_publisher(
                bus.session,
                full,
                cache=ext.CacheConfig(max_samples=_CACHE),
                sample_miss_detection=ext.MissDetectionConfig(heartbeat=0.5, sporadic_heartbeat=None),
                publisher_detection=True,
                **quiet,
            )
        else:
            self._writer = bus.session.declare_publisher(full, **quiet)

    def put_payload(self, payload: bytes) -> None:
        clock = self._clock
        try:
            self._writer.put(payload, attachment=_STAMP.pack(self._sequence, clock.unix_ns(), clock.sim_ns))
        except zenoh.ZError as error:
            raise BusError(f"this bus is closed ({first_line(error)})") from None
        self._sequence += 1

    def wanted(self) -> bool:
        if self.topic.delivery is Delivery.RECOVERED:
            return True  # Zenoh does not tell for writers with a cache, and the cache wants all samples anyway
        return bool(self._writer.matching_status.matching)


class _Subscription(Subscription):
    """Samples wait in a channel of Zenoh's own, filled without Python: neither side ever waits for the other's GIL.

    A channel can be waited on only without end, so a wait that has one is ended by a poke: a sample that the bus's
    alarm puts on this reader's own key, heard by nobody else.
    """

    def __init__(self, topic: Topic, key: str, bus: "ZenohBus", newest: bool, past: bool) -> None:
        self._topic = topic
        self._bus = bus
        self._start = len(bus.prefix)
        self._newest = newest or topic.delivery is Delivery.NEWEST
        self._timed = not bus.is_client
        self._waits_until: float | None = None
        self._ended = False
        self._kept: dict[str, Received] = {}
        full = bus.prefix + key
        self._poke_key = full.replace("*", _POKE)
        self._reader: Any
        if topic.delivery is Delivery.RECOVERED and not self._newest:
            recovery = ext.RecoveryConfig(heartbeat=True, periodic_queries=None)
            history = ext.HistoryConfig(detect_late_publishers=True, max_samples=_CACHE) if past else None
            every: Any = zenoh.handlers.FifoChannel(_BACKLOG)
            self._reader = ext.declare_advanced_subscriber(bus.session, full, every, history=history, recovery=recovery)
        else:
            # one place beside the newest, so that a poke never pushes it out; a wildcard needs all keys' samples
            ring = self._newest and "*" not in key
            channel: Any = zenoh.handlers.RingChannel(2) if ring else zenoh.handlers.FifoChannel(_BACKLOG)
            self._reader = bus.session.declare_subscriber(full, channel)

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

    def _next(self, timeout: float | None) -> Received | None:
        """The next message of this topic in the channel; a poke ends the waiting."""
        reader, start = self._reader, self._start
        try:
            while True:
                sample = reader.try_recv()
                if sample is None:
                    if timeout == 0.0 or self._ended:
                        return None
                    sample = self._wait(timeout)
                attachment = sample.attachment
                raw = attachment.to_bytes() if attachment is not None else b""
                if raw == _POKE_MARK:
                    timeout = 0.0
                    continue
                key = str(sample.key_expr)[start:]
                if key not in _LITERAL_KEYS or key == self._topic.key:
                    stamp = Stamp(*_STAMP.unpack(raw)) if len(raw) == _STAMP.size else None
                    arrived = _arrival(sample) if self._timed else 0
                    return Received(self._topic, key, sample.payload.to_bytes(), stamp, arrived)
        except zenoh.ZError:
            return None  # the session was closed meanwhile

    def _wait(self, timeout: float | None) -> zenoh.Sample:
        """The next sample in the channel, however long it takes."""
        if timeout is not None:
            self._waits_until = self._bus.clock.now() + timeout
            self._bus.wake_alarm()
        sample: zenoh.Sample = self._reader.recv()
        self._waits_until = None
        return sample

    def poke_if_due(self, now: float) -> None:
        """End a wait that has lasted long enough."""
        until = self._waits_until
        if until is not None and now >= until:
            self.poke()

    def poke(self) -> None:
        """End a wait."""
        self._bus.session.put(self._poke_key, b"", attachment=_POKE, allowed_destination=zenoh.Locality.SESSION_LOCAL)

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


class _Question(Question):
    def __init__(self, topic: Topic, query: zenoh.Query) -> None:
        super().__init__(topic, topic.key, query.payload.to_bytes() if query.payload is not None else b"")
        self._query = query

    def answer(self, reply: Message) -> None:
        with self._query as query:
            query.reply(query.key_expr, reply.encode(), encoding=zenoh.Encoding.APPLICATION_JSON)

    def fail(self, reason: str) -> None:
        with self._query as query:
            query.reply_err(reason)


class _Server(Server):
    def __init__(self, topic: Topic, key: str, bus: "ZenohBus") -> None:
        self.mailbox: EveryMailbox[Question] = EveryMailbox()

        def bring(query: zenoh.Query) -> None:
            self.mailbox.put("", _Question(topic, query))

        self._queryable = bus.session.declare_queryable(
            bus.prefix + key, zenoh.handlers.Callback(bring, indirect=False)
        )

    def receive(self, timeout: float | None = 0.0) -> Question | None:
        return self.mailbox.take(timeout)


class _Answer(Answer):
    def __init__(self, topic: Topic, key: str, question: Message, timeout: float, bus: "ZenohBus") -> None:
        self._topic, self._key = topic, key
        mailbox: EveryMailbox[bytes | str] = EveryMailbox()
        self._mailbox = mailbox

        def bring(reply: zenoh.Reply) -> None:
            if reply.ok is not None:
                mailbox.put("", reply.ok.payload.to_bytes())
            elif reply.err is not None:
                mailbox.put("", reply.err.payload.to_string())

        def nobody() -> None:
            mailbox.put("", f"nobody answers {key}")

        bus.session.get(
            bus.prefix + key,
            zenoh.handlers.Callback(bring, nobody, indirect=False),
            payload=question.encode(),
            timeout=timeout,
        )

    def result(self, timeout: float) -> Any:
        reply = self._mailbox.take(timeout)
        if reply is None:
            raise NoAnswerError(f"nobody answers {self._key} within {timeout:g} s")
        if isinstance(reply, str):
            raise NoAnswerError(reply)
        assert self._topic.reply is not None
        return self._topic.reply.decode(reply)


class _Watch(PresenceWatch):
    def __init__(self, bus: "ZenohBus") -> None:
        self.mailbox: EveryMailbox[Presence] = EveryMailbox()
        start = len(bus.prefix)
        row = TOPICS["alive"]

        def bring(sample: zenoh.Sample) -> None:
            chunks = row.match(str(sample.key_expr)[start:])
            if chunks:
                alive = sample.kind == zenoh.SampleKind.PUT
                self.mailbox.put("", Presence(chunks["kind"], chunks["name"], alive))

        self._watch = bus.session.liveliness().declare_subscriber(
            bus.prefix + row.fill(), zenoh.handlers.Callback(bring, indirect=False), history=True
        )

    def receive(self, timeout: float | None = 0.0) -> Presence | None:
        return self.mailbox.take(timeout)


class ZenohBus(Bus):
    """A seat on a Zenoh network."""

    def __init__(self, match: str, clock: Clock, session: zenoh.Session, *, is_client: bool) -> None:
        super().__init__(match, clock)
        self.session = session
        self.prefix = root(match)
        self._mailboxes: list[EveryMailbox[Any]] = []
        self._subscriptions: list[_Subscription] = []
        self._tokens: dict[str, zenoh.LivelinessToken] = {}
        self.is_client = is_client
        self._alarm: threading.Thread | None = None
        self._leaving = threading.Event()
        _close_at_exit(self)

    def publisher(self, topic: Topic, **chunks: str) -> Publisher:
        check_publishable(topic)
        return _Publisher(topic, full_key(topic, chunks), self._open())

    def subscribe(self, topic: Topic, *, newest: bool = False, past: bool = False, **chunks: str) -> Subscription:
        check_publishable(topic)
        subscription = _Subscription(topic, topic.fill(**chunks), self._open(), newest, past)
        self._subscriptions.append(subscription)
        return subscription

    def serve(self, topic: Topic, **chunks: str) -> Server:
        server = _Server(topic, full_key(topic, chunks), self._open())
        self._mailboxes.append(server.mailbox)
        return server

    def ask(self, topic: Topic, question: Message, timeout: float = 2.0, **chunks: str) -> Answer:
        return _Answer(topic, full_key(topic, chunks), question, timeout, self._open())

    def declare_alive(self, kind: str, name: str) -> None:
        key = self.prefix + TOPICS["alive"].fill(kind=kind, name=name)
        self._tokens[key] = self._open().session.liveliness().declare_token(key)

    def withdraw_alive(self, kind: str, name: str) -> None:
        self._open()
        token = self._tokens.pop(self.prefix + TOPICS["alive"].fill(kind=kind, name=name), None)
        if token is not None:
            token.undeclare()  # type: ignore[no-untyped-call]

    def watch_alive(self) -> PresenceWatch:
        watch = _Watch(self._open())
        self._mailboxes.append(watch.mailbox)
        return watch

    def connected(self) -> bool:
        if self._closed:
            return False
        return not self.is_client or bool(self.session.info.routers_zid())

    def wake_alarm(self) -> None:
        """Make sure that waits which have an end are ended."""
        if self._alarm is None:
            alarm = threading.Thread(target=self._ring, name="bus-alarm", daemon=True)
            alarm.start()
            self._alarm = alarm  # only now: a signal within `start` must not leave a thread that cannot be joined

    def _ring(self) -> None:
        while not self._leaving.wait(_ALARM_S):
            now = self.clock.now()
            for subscription in tuple(self._subscriptions):
                subscription.poke_if_due(now)

    def close(self) -> None:
        if self._closed:
            return
        self._closed = True
        self._leaving.set()
        if self._alarm is not None and self._alarm is not threading.current_thread():
            self._alarm.join()
        for subscription in self._subscriptions:
            subscription.end()
        for mailbox in self._mailboxes:
            mailbox.end()
        try:
            self.session.close()  # type: ignore[no-untyped-call]
        except zenoh.ZError:
            return  # the peer was gone first; nothing is left to close

    def _open(self) -> "ZenohBus":
        if self._closed:
            raise BusError("this bus is closed")
        return self


def _arrival(sample: zenoh.Sample) -> int:
    """When the host's router stamped the sample: where and when it came in, ns since 1970; 0 when it did not."""
    stamp = sample.timestamp
    return stamp.get_time_as_ntp64().as_nanos() if stamp is not None else 0


def _close_at_exit(bus: ZenohBus) -> None:
    """Close before Zenoh's threads are joined: an interpreter that exits with an open session hangs."""
    seat = weakref.ref(bus)

    def close() -> None:
        left = seat()
        if left is not None:
            left.close()

    threading._register_atexit(close)  # type: ignore[attr-defined]
