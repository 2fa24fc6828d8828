"""The interface of a bus: publish, subscribe, query, serve, and liveliness tokens, by the rows of the topic table.

All other code uses this interface. `zenoh.bus` implements it; tests have a bus within one process that passes the same
conformance suite.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from types import TracebackType
from typing import Any, NamedTuple, Self
from uuid import uuid4

from runtime.access.accounts import Account
from runtime.bus.mailbox import Mailbox
from runtime.bus.refusals import Refusals
from runtime.process.clock import Clock
from runtime.process.timing import REQUEST_S
from schemas.errors import TouchlineError
from schemas.tokens import PresenceKind as PresenceKind
from schemas.topic import Delivery, Topic
from schemas.wire.message import VERSION, BadMessageError, Message
from schemas.wire.part import encode


class BusError(TouchlineError):
    """The bus could not be opened, or is closed."""


class EndpointInUseError(BusError):
    """Another process listens on the endpoint."""


class NoReplyError(Exception):
    """No reply arrived in time, or the server reported that there is none."""


class RefusedQueryError(NoReplyError):
    """The server has received the query, and reports why there is no reply."""


class Stamp(NamedTuple):
    """Metadata that the bus sends with each message."""

    sequence: int
    """Counts the publisher's messages on this key, from 0; a gap is a loss."""
    sent_ns: int
    """The publisher's wall time, ns since 1970."""
    sim_ns: int
    """The publisher's simulated time in ns, −1 where it has none."""


class ReceivedMessage(NamedTuple):
    """A message as it arrived; decoded on demand."""

    topic: Topic
    key: str
    """Key below the match, `robot/cyan1/sight`."""
    payload: bytes
    stamp: Stamp | None
    """None where the publisher does not use this library."""
    arrived_ns: int = 0
    """Wall time at which the message reached the host, by the host's clock, ns since 1970; 0 where unknown."""

    @property
    def chunks(self) -> dict[str, str]:
        """The variable chunks of the key."""
        return self.topic.match(self.key) or {}

    def message(self) -> Any:
        """The validated message.

        Raises:
            BadMessageError: the payload is not a message of this topic.
        """
        if self.topic.message is None:
            raise BadMessageError(f"{self.key} carries no message")
        return self.topic.message.decode(self.payload)


@dataclass(frozen=True, slots=True)
class Presence:
    """A liveliness token appeared or disappeared."""

    kind: PresenceKind
    name: str
    alive: bool


class Publisher(ABC):
    """Publishes on one key."""

    def __init__(self, topic: Topic, key: str) -> None:
        self.topic = topic
        self.key = key

    def put(self, message: Message) -> Stamp:
        """Publish a message, without waiting for subscribers."""
        return self.put_payload(message.encode())

    def put_fields(self, fields: dict[str, Any]) -> Stamp:
        """Publish a message from plain fields in the order of its model, for messages that are sent often in each tick.

        Does no validation, for speed: subscribers validate, and refuse NaN, which is encoded as null.
        """
        return self.put_payload(encode({"version": VERSION, **fields}))

    @abstractmethod
    def put_payload(self, payload: bytes) -> Stamp:
        """Publish an encoded message; returns the stamp sent with it."""

    @abstractmethod
    def put_copy(self, payload: bytes, stamp: Stamp) -> None:
        """Publish a message again with the stamp that it had: subscribers that receive one of the two lost nothing."""

    @abstractmethod
    def has_subscribers(self) -> bool:
        """Whether the key has subscribers; always true on a `recovered` topic, whose messages can be fetched later."""


class Subscription(ABC):
    """Receives the messages of one topic."""

    @abstractmethod
    def receive(self, timeout: float | None = 0.0) -> ReceivedMessage | None:
        """The next message, waiting up to `timeout` s for it (None: without limit); None without a message."""

    def receive_payload(self, timeout: float | None = 0.0) -> bytes | None:
        """The payload of the next message, for callers that need nothing else; otherwise as `receive`."""
        received = self.receive(timeout)
        return received.payload if received is not None else None

    @abstractmethod
    def close(self) -> None:
        """Unsubscribe; a waiting `receive` returns None."""


class Query(ABC):
    """A query that waits for its reply."""

    def __init__(self, topic: Topic, key: str, payload: bytes) -> None:
        self.topic = topic
        self.key = key
        self.payload = payload

    def message(self) -> Any:
        """The validated request.

        Raises:
            BadMessageError: the payload is not a message of this topic.
        """
        assert self.topic.message is not None
        return self.topic.message.decode(self.payload)

    def reply(self, reply: Message) -> None:
        """Send the reply; once."""
        self.reply_payload(reply.encode())

    @abstractmethod
    def reply_payload(self, payload: bytes) -> None:
        """Send an encoded reply; once."""

    @abstractmethod
    def fail(self, reason: str) -> None:
        """Report that there is no reply, and why; once."""


class Server:
    """Serves the queries of one topic, which wait in a mailbox."""

    def __init__(self) -> None:
        self.mailbox: Mailbox[Query] = Mailbox()

    def receive(self, timeout: float | None = 0.0) -> Query | None:
        """The next query; as `Subscription.receive`."""
        return self.mailbox.get(timeout)


class PendingReply:
    """A reply that is on its way to a mailbox."""

    def __init__(self, topic: Topic, key: str) -> None:
        self._topic, self._key = topic, key
        self.mailbox: Mailbox[bytes | NoReplyError] = Mailbox()

    def result(self, timeout: float) -> Any:
        """The reply, waiting up to `timeout` s.

        Raises:
            NoReplyError: no reply came.
            RefusedQueryError: the server reported that there is none, with the reason.
            BadMessageError: the payload is not a reply of this topic.
        """
        assert self._topic.reply is not None
        return self._topic.reply.decode(self.payload(timeout))

    def payload(self, timeout: float) -> bytes:
        """The bytes of the reply, waiting up to `timeout` s.

        Raises:
            NoReplyError: as `result`.
        """
        reply = self.mailbox.get(timeout)
        if reply is None:
            raise NoReplyError(f"no process answers {self._key} within {timeout:g} s")
        if isinstance(reply, NoReplyError):
            raise reply
        return reply


class PresenceWatch:
    """Watches liveliness tokens; begins with those that exist."""

    def __init__(self) -> None:
        self.mailbox: Mailbox[Presence] = Mailbox()
        self.is_empty = self.mailbox.is_empty
        """Whether no change is waiting: cheap, for callers that poll."""

    def receive(self, timeout: float | None = 0.0) -> Presence | None:
        """The next change; as `Subscription.receive`."""
        return self.mailbox.get(timeout)


@dataclass(eq=False)
class Bus(ABC):
    """One process's connection to the bus of one match."""

    match: str
    clock: Clock
    name: str = field(default_factory=lambda: uuid4().hex[:8], init=False)
    """A name that no other connection has."""
    account: Account | None = field(default=None, init=False)
    """The account of a client with credentials."""
    refusals: Refusals = field(default_factory=Refusals, init=False)
    """What was refused before any reader received it."""
    _closed: bool = field(default=False, init=False)

    @property
    def closed(self) -> bool:
        """Whether this connection was closed here; its subscriptions then return None without waiting."""
        return self._closed

    @abstractmethod
    def publisher(self, topic: Topic, **chunks: str) -> Publisher:
        """A publisher for one key; every chunk must be given."""

    @abstractmethod
    def subscribe(self, topic: Topic, *, newest: bool = False, history: bool = False, **chunks: str) -> Subscription:
        """A subscription to a topic; without a chunk, to all its values.

        A topic with the delivery `newest`, or any topic with `newest`, yields only the newest message of each key;
        others yield every message that arrives. With `history`, a `recovered` topic first yields the messages in its
        publishers' caches. A publisher that comes while the host learns of the subscription may be heard from a later
        message on: Zenoh then drops what its cache yields after that.
        """

    @abstractmethod
    def subscribe_each(self, topic: Topic, **chunks: Sequence[str]) -> Subscription:
        """One subscription to several keys of a topic, which yields the newest message of each.

        The first key has the first value of each chunk, and so on; every chunk must be given.
        """

    @abstractmethod
    def serve(self, topic: Topic, **chunks: str) -> Server:
        """Serve the queries of this topic; without a chunk, of all its values."""

    @abstractmethod
    def query(
        self, topic: Topic, request: Message, timeout: float = REQUEST_S, *, droppable: bool = False, **chunks: str
    ) -> PendingReply:
        """Send a query; it is open for `timeout` s.

        With `droppable`, a request or a reply is dropped where a link is congested. Otherwise a process with a long
        reply would wait for a requester that has stopped reading.
        """

    @abstractmethod
    def declare_alive(self, kind: PresenceKind, name: str) -> None:
        """Declare the token `alive/{kind}/{name}`; without effect where it is declared already.

        It exists until it is withdrawn, this bus is closed, or its process dies.
        """

    @abstractmethod
    def withdraw_alive(self, kind: PresenceKind, name: str) -> None:
        """Withdraw a token; without effect where it was not declared."""

    @abstractmethod
    def watch_alive(self) -> PresenceWatch:
        """Watch the tokens of all processes; tokens of unknown kinds are ignored."""

    @abstractmethod
    def connected(self) -> bool:
        """Whether the medium is available: for a client, whether its link to the host is up."""

    def is_cut_off(self) -> bool:
        """Whether nothing answers at the host's address, neither a listener nor its machine; takes a moment."""
        return False

    @abstractmethod
    def close(self) -> None:
        """Close the connection; further use raises `BusError`. Safe to call twice."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def check_publishable(topic: Topic) -> None:
    """Refuse a topic of queries or tokens."""
    if topic.delivery in (Delivery.QUERY, Delivery.PRESENCE):
        raise BusError(f"{topic.key} is not published; its delivery is {topic.delivery.value}")


def full_key(topic: Topic, chunks: dict[str, str]) -> str:
    """The key with all its chunks."""
    missing = [name for name in topic.chunks if name not in chunks]
    if missing:
        raise BusError(f"topic {topic.key} needs {', '.join(missing)} to be published")
    return topic.fill(**chunks)


def full_keys(topic: Topic, chunks: dict[str, Sequence[str]]) -> list[str]:
    """The keys that have the first value of each chunk, the second one, and so on."""
    return [full_key(topic, dict(zip(chunks, values, strict=True))) for values in zip(*chunks.values(), strict=True)]
