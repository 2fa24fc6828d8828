"""The bus within one process: the same behaviour as that over Zenoh, without a network."""

import threading
from collections import defaultdict, deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from runtime.bus.contract import (
    Bus,
    BusError,
    NoReplyError,
    PendingReply,
    Presence,
    PresenceKind,
    PresenceWatch,
    Publisher,
    Query,
    ReceivedMessage,
    RefusedQueryError,
    Server,
    Stamp,
    Subscription,
    check_publishable,
    full_key,
    full_keys,
)
from runtime.bus.mailbox import Mailbox
from runtime.process.clock import Clock
from schemas.topic import Delivery, Topic
from schemas.wire.message import Message


@dataclass(eq=False)
class SharedState:
    """The shared state of the buses of one process, in place of a network."""

    lock: threading.Lock = field(default_factory=threading.Lock)
    subscriptions: dict[str, list["_Subscription"]] = field(default_factory=dict)
    servers: dict[str, Server] = field(default_factory=dict)
    alive: dict[tuple[str, str], int] = field(default_factory=dict)
    watches: list["_Watch"] = field(default_factory=list)
    caches: dict[str, dict[str, deque[ReceivedMessage]]] = field(default_factory=dict)
    """Match and topic → key → messages that the publisher of a `recovered` topic keeps."""

    def open_bus(self, match: str, clock: Clock) -> "InProcessBus":
        """A new bus for a match."""
        return InProcessBus(match, clock, self)

    def count_token(self, match: str, token: tuple[str, str], by: int) -> None:
        """Count a token; watches are notified when the first appears or the last disappears."""
        with self.lock:
            before = self.alive.get(token, 0)
            self.alive[token] = before + by
            if (before == 0) != (before + by == 0):
                for watch in self.watches:
                    if watch.match == match:
                        kind = PresenceKind(token[0].removeprefix(match + "/"))
                        watch.mailbox.put(Presence(kind, token[1], by > 0))


class _Publisher(Publisher):
    def __init__(self, topic: Topic, key: str, bus: "InProcessBus") -> None:
        super().__init__(topic, key)
        self._bus = bus
        self._sequence = 0
        self._kept: deque[ReceivedMessage] | None = None
        if topic.delivery is Delivery.RECOVERED:
            self._kept = bus.keep(topic, key)

    def put_payload(self, payload: bytes) -> Stamp:
        bus = self._bus
        bus.check_open()
        stamp = Stamp(self._sequence, bus.clock.unix_ns(), bus.clock.sim_ns)
        self._sequence += 1
        self._deliver(ReceivedMessage(self.topic, self.key, payload, stamp, stamp.sent_ns))
        return stamp

    def put_copy(self, payload: bytes, stamp: Stamp) -> None:
        self._bus.check_open()
        self._deliver(ReceivedMessage(self.topic, self.key, payload, stamp, self._bus.clock.unix_ns()))

    def _deliver(self, received: ReceivedMessage) -> None:
        bus = self._bus
        with bus.shared_state.lock:
            if self._kept is not None:
                self._kept.append(received)
            for subscription in bus.shared_state.subscriptions.get(bus.prefix + self.topic.key, ()):
                subscription.deliver(self.key, received)

    def has_subscribers(self) -> bool:
        if self.topic.delivery is Delivery.RECOVERED:
            return True
        readers = self._bus.shared_state.subscriptions.get(self._bus.prefix + self.topic.key, ())
        return any(reader.wants(self.key) for reader in readers)


class _Subscription(Subscription):
    def __init__(self, topic: Topic, wanted: list[dict[str, str]], bus: "InProcessBus", newest: bool) -> None:
        self._wanted = wanted
        self._topic = topic
        self._bus = bus
        one = newest or topic.delivery is Delivery.NEWEST
        self._keys: Mailbox[str] = Mailbox()
        self._received: dict[str, deque[ReceivedMessage]] = defaultdict(lambda: deque(maxlen=1 if one else None))

    def wants(self, key: str) -> bool:
        chunks = self._topic.match(key) or {}
        return any(all(chunks[name] == value for name, value in wanted.items()) for wanted in self._wanted)

    def deliver(self, key: str, received: ReceivedMessage) -> None:
        if self.wants(key):
            self._received[key].append(received)
            self._keys.put(key)

    def receive(self, timeout: float | None = 0.0) -> ReceivedMessage | None:
        while (key := self._keys.get(timeout)) is not None:
            if self._received[key]:  # replaced messages leave keys behind
                return self._received[key].popleft()
        return None

    def close(self) -> None:
        with self._bus.shared_state.lock:
            readers = self._bus.shared_state.subscriptions.get(self._bus.prefix + self._topic.key, [])
            if self in readers:
                readers.remove(self)
        self._keys.close()


class _Query(Query):
    def __init__(self, topic: Topic, key: str, payload: bytes, answer: PendingReply) -> None:
        super().__init__(topic, key, payload)
        self._answer = answer

    def reply_payload(self, payload: bytes) -> None:
        self._answer.mailbox.put(payload)

    def fail(self, reason: str) -> None:
        self._answer.mailbox.put(RefusedQueryError(reason))


class _Watch(PresenceWatch):
    def __init__(self, match: str) -> None:
        super().__init__()
        self.match = match


class InProcessBus(Bus):
    """A bus on a `SharedState`; payloads are encoded and validated as over a network."""

    def __init__(self, match: str, clock: Clock, shared_state: SharedState) -> None:
        super().__init__(match, clock)
        self.shared_state = shared_state
        self.prefix = f"{match}/"
        self._tokens: list[tuple[str, str]] = []
        self._served: list[str] = []
        self._subscriptions: list[_Subscription] = []
        self._mailboxes: list[Mailbox[Any]] = []
        self._kept: list[tuple[str, str]] = []

    def keep(self, topic: Topic, key: str) -> deque[ReceivedMessage]:
        """The cache of a publisher of this key, for as long as its bus is open."""
        kept: deque[ReceivedMessage] = deque(maxlen=topic.cache_size)
        with self.shared_state.lock:
            self.shared_state.caches.setdefault(self.prefix + topic.key, {})[key] = kept
        self._kept.append((self.prefix + topic.key, key))
        return kept

    def check_open(self) -> None:
        """Raise `BusError` where this bus is closed."""
        if self._closed:
            raise BusError("this bus is closed")

    def publisher(self, topic: Topic, **chunks: str) -> Publisher:
        self.check_open()
        check_publishable(topic)
        return _Publisher(topic, full_key(topic, chunks), self)

    def subscribe(self, topic: Topic, *, newest: bool = False, history: bool = False, **chunks: str) -> Subscription:
        self.check_open()
        check_publishable(topic)
        topic.fill(**chunks)
        return self._add(_Subscription(topic, [chunks], self, newest), topic, history=history)

    def subscribe_each(self, topic: Topic, **chunks: Sequence[str]) -> Subscription:
        self.check_open()
        check_publishable(topic)
        wanted = [topic.match(key) or {} for key in full_keys(topic, chunks)]
        return self._add(_Subscription(topic, wanted, self, newest=True), topic, history=False)

    def _add(self, subscription: _Subscription, topic: Topic, *, history: bool) -> Subscription:
        with self.shared_state.lock:
            for kept in self.shared_state.caches.get(self.prefix + topic.key, {}).values() if history else ():
                for received in kept:
                    subscription.deliver(received.key, received)
            self.shared_state.subscriptions.setdefault(self.prefix + topic.key, []).append(subscription)
        self._subscriptions.append(subscription)
        return subscription

    def serve(self, topic: Topic, **chunks: str) -> Server:
        self.check_open()
        server = Server()
        key = self.prefix + topic.fill(**chunks)
        with self.shared_state.lock:
            self.shared_state.servers[key] = server
        self._served.append(key)
        self._mailboxes.append(server.mailbox)
        return server

    def query(
        self, topic: Topic, request: Message, timeout: float = 2.0, *, droppable: bool = False, **chunks: str
    ) -> PendingReply:
        self.check_open()
        del timeout, droppable  # a request waits with its server or is refused at once
        key = full_key(topic, chunks)
        answer = PendingReply(topic, key)
        servers = self.shared_state.servers
        server = servers.get(self.prefix + key) or servers.get(self.prefix + topic.fill())
        if server is None:
            answer.mailbox.put(NoReplyError(f"no process answers {key}"))
        else:
            server.mailbox.put(_Query(topic, key, request.encode(), answer))
        return answer

    def declare_alive(self, kind: PresenceKind, name: str) -> None:
        self.check_open()
        token = (self.prefix + kind, name)
        if token not in self._tokens:
            self._tokens.append(token)
            self.shared_state.count_token(self.match, token, +1)

    def withdraw_alive(self, kind: PresenceKind, name: str) -> None:
        self.check_open()
        token = (self.prefix + kind, name)
        if token in self._tokens:
            self._tokens.remove(token)
            self.shared_state.count_token(self.match, token, -1)

    def watch_alive(self) -> PresenceWatch:
        self.check_open()
        watch = _Watch(self.match)
        with self.shared_state.lock:
            self.shared_state.watches.append(watch)
            for (kind, name), count in self.shared_state.alive.items():
                if count and kind.startswith(self.prefix):
                    watch.mailbox.put(Presence(PresenceKind(kind.removeprefix(self.prefix)), name, True))
        self._mailboxes.append(watch.mailbox)
        return watch

    def connected(self) -> bool:
        return not self._closed

    def close(self) -> None:
        if self._closed:
            return
        for token in self._tokens:
            self.shared_state.count_token(self.match, token, -1)
        self._closed = True
        for subscription in self._subscriptions:
            subscription.close()
        for key in self._served:
            self.shared_state.servers.pop(key, None)
        for mailbox in self._mailboxes:
            mailbox.close()
        with self.shared_state.lock:
            for topic, key in self._kept:
                self.shared_state.caches.get(topic, {}).pop(key, None)
