"""What every bus offers: publish, subscribe, query, serve, and liveliness tokens, by the rows of the topic table.

The rest of the code is written against this module alone; `zenoh.bus` and `in_process_bus` behave alike, and one
conformance suite runs over both.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum
from types import TracebackType
from typing import Any, NamedTuple, Self

from schemas.errors import TouchlineError
from schemas.message import VERSION, BadMessageError, WireMessage
from schemas.process.clock import Clock
from schemas.struct import encode
from schemas.topic import Delivery, Topic

LEASE_S = 2.0
"""Wall time without a sign of life after which a link counts as broken."""
HEARTBEAT_S = 0.5
"""Wall time after which a reader of a `recovered` topic knows at the latest that it missed the newest message."""


class BusError(TouchlineError):
    """The bus could not be opened, or is closed."""


class NoReplyError(Exception):
    """No reply came in time."""


class Stamp(NamedTuple):
    """What the bus sends along with each message."""

    sequence: int
    """Counts this writer's messages on this key, from 0; a gap is a loss."""
    sent_ns: int
    """Writer's wall time, ns since 1970."""
    sim_ns: int
    """Writer's simulated time in ns, −1 when it knows none."""


class ReceivedMessage(NamedTuple):
    """A message as it came: read only when somebody asks for it."""

    topic: Topic
    key: str
    """Key below the match, `robot/cyan1/sight`."""
    payload: bytes
    stamp: Stamp | None
    """Nothing when the writer did not use this library."""
    arrived_ns: int = 0
    """When the message reached the host, by the host's wall clock, ns since 1970; 0 when that is not known."""

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


class PresenceKind(StrEnum):
    """What a process is, by its liveliness token `alive/{kind}/{name}`."""

    HOST = "host"
    REPLAY = "replay"
    """Beside `host`: this host plays a recording."""
    AGENT = "agent"
    """Its name is that of its robot."""
    RECORDER = "recorder"
    COACH = "coach"
    """A page or a terminal that shows the match."""
    REFBOX = "refbox"
    """A base station that hears a league's referee box; its name is the side's."""


@dataclass(frozen=True, slots=True)
class Presence:
    """A process came or went."""

    kind: PresenceKind
    name: str
    alive: bool


class Publisher(ABC):
    """Writes one key."""

    def __init__(self, topic: Topic, key: str) -> None:
        self.topic = topic
        self.key = key

    def put(self, message: WireMessage) -> Stamp:
        """Send a message; never waits for readers."""
        return self.put_payload(message.encode())

    def put_fields(self, fields: dict[str, Any]) -> Stamp:
        """Send a message given as plain fields, laid out as its model has them.

        Nothing is validated here, for speed: the reader validates, and refuses a NaN, which is null here. For messages
        sent many times per tick.
        """
        return self.put_payload(encode({"version": VERSION, **fields}))

    @abstractmethod
    def put_payload(self, payload: bytes) -> Stamp:
        """Send bytes that are a message already; returns what travels beside them."""

    @abstractmethod
    def has_subscribers(self) -> bool:
        """Whether anybody listens to this key just now; always, where what was sent can be recovered later."""


class Subscription(ABC):
    """Reads the keys of one topic."""

    @abstractmethod
    def receive(self, timeout: float | None = 0.0) -> ReceivedMessage | None:
        """The next message, waiting up to `timeout` s for it (None: for ever); nothing when there is none."""

    def receive_payload(self, timeout: float | None = 0.0) -> bytes | None:
        """The payload of the next message alone, for who asks for nothing else of it; as `receive`."""
        received = self.receive(timeout)
        return received.payload if received is not None else None

    @abstractmethod
    def close(self) -> None:
        """Stop listening; a waiting `receive` returns nothing."""


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

    @abstractmethod
    def reply(self, reply: WireMessage) -> None:
        """Send the reply; once."""

    @abstractmethod
    def reply_payload(self, payload: bytes) -> None:
        """Answer it, once, with bytes that are a reply already."""

    @abstractmethod
    def fail(self, reason: str) -> None:
        """Report that there is no reply, and why; once."""


class Server(ABC):
    """Serves the queries of one topic."""

    @abstractmethod
    def receive(self, timeout: float | None = 0.0) -> Query | None:
        """The next query; as `Subscription.receive`."""


class PendingReply(ABC):
    """A reply that is on its way."""

    def __init__(self, topic: Topic) -> None:
        self._topic = topic

    def result(self, timeout: float) -> Any:
        """The reply, waiting up to `timeout` s.

        Raises:
            NoReplyError: no reply came, or the server reported that there is none, with the reason.
            BadMessageError: the payload is not a reply of this topic.
        """
        assert self._topic.reply is not None
        return self._topic.reply.decode(self.payload(timeout))

    @abstractmethod
    def payload(self, timeout: float) -> bytes:
        """The bytes of the reply, waiting up to `timeout` s.

        Raises:
            NoReplyError: as `result`.
        """


class PresenceWatch(ABC):
    """Sees processes come and go; begins with those that are there."""

    is_empty: Callable[[], bool]
    """Whether nothing waits to be received: for who asks often, and mostly in vain."""

    @abstractmethod
    def receive(self, timeout: float | None = 0.0) -> Presence | None:
        """The next change; as `Subscription.receive`."""


@dataclass
class Bus(ABC):
    """One process's connection to the bus of one match."""

    match: str
    clock: Clock
    _closed: bool = field(default=False, init=False)

    @abstractmethod
    def publisher(self, topic: Topic, **chunks: str) -> Publisher:
        """A writer for one key: every chunk must be given."""

    @abstractmethod
    def subscribe(self, topic: Topic, *, newest: bool = False, history: bool = False, **chunks: str) -> Subscription:
        """A reader for a topic; a chunk left out reads every value of it.

        A topic delivered `newest` yields the newest message of each key, any other every message that arrives, unless
        the reader wants the `newest` alone. Where the writer keeps what it sent (`recovered`), `history` yields
        that first.
        """

    @abstractmethod
    def serve(self, topic: Topic, **chunks: str) -> Server:
        """Serve the queries of this topic; every chunk must be given."""

    @abstractmethod
    def query(
        self, topic: Topic, request: WireMessage, timeout: float = 2.0, *, droppable: bool = False, **chunks: str
    ) -> PendingReply:
        """Send a query; `timeout` is how long it stays open, in s.

        With `droppable`, a question or an answer that finds no room on its way is dropped: no process waits for the
        room, as one that answers at length would for an asker that stands still.
        """

    @abstractmethod
    def declare_alive(self, kind: PresenceKind, name: str) -> None:
        """Be seen as `alive/{kind}/{name}` until that is withdrawn, this bus is closed or its process dies."""

    @abstractmethod
    def withdraw_alive(self, kind: PresenceKind, name: str) -> None:
        """Be seen so no more; nothing where one was not."""

    @abstractmethod
    def watch_alive(self) -> PresenceWatch:
        """See others come and go; tokens of other kinds are passed over."""

    @abstractmethod
    def connected(self) -> bool:
        """Whether the medium is there: a client's link to its host is up."""

    @abstractmethod
    def close(self) -> None:
        """Leave; further use raises `BusError`. Safe to call twice."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def check_publishable(topic: Topic) -> None:
    """Refuse a topic that is not written but asked or declared."""
    if topic.delivery in (Delivery.QUERY, Delivery.PRESENCE):
        raise BusError(f"{topic.key} is not published; it travels as {topic.delivery.value}")


def full_key(topic: Topic, chunks: dict[str, str]) -> str:
    """The one key that these chunks name."""
    missing = [name for name in topic.chunks if name not in chunks]
    if missing:
        raise BusError(f"topic {topic.key} needs {', '.join(missing)} to be written")
    return topic.fill(**chunks)
