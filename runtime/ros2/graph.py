"""A node of a ROS 2 graph: its publishers, subscriptions and services on a Zenoh session, visible by liveliness tokens.

What arrives waits in a queue, and is handed to callbacks on one thread of the graph, in the order in which it came. A
call of Python code on a thread of Zenoh costs 8 µs more: each one makes and frees an interpreter's state and stack.
"""

import threading
import traceback
from collections.abc import Callable
from queue import SimpleQueue
from typing import Any, NamedTuple

import zenoh
from zenoh import ext

from runtime.access.protection import Protection
from runtime.bus.contract import BusError
from runtime.bus.zenoh.session import first_line, open_connection, open_router
from runtime.process.clock import Clock
from runtime.process.process_log import Level, log_line
from runtime.process.timing import HEARTBEAT_S
from runtime.ros2.graph_names import Attachment, Endpoint, Kind, NodeName, data_key, endpoint_of, gid_of, tokens_of
from runtime.ros2.message_types import hash_of
from runtime.ros2.topic_type import TopicType

_BACKLOG = 10_000
"""Most samples and queries that wait to be handled; of more, the oldest are dropped."""


class Arrived(NamedTuple):
    """A message of a subscription."""

    payload: bytes
    attachment: Attachment | None
    """None if it has none, or one of another form; nodes of rmw_zenoh then drop the message."""


def open_graph(
    node: str,
    clock: Clock,
    domain: int,
    listen: str | None,
    router: str | None,
    patience: float,
    protection: Protection | None = None,
) -> "Graph":
    """A node in a graph: through the ROS router at `router`, or as the router that listens at `listen`.

    With `protection` that router admits its accounts only.

    Raises:
        BusError: nothing answers at `router` for `patience` s of wall time, or `listen` cannot be listened on.
    """
    if router is None:
        # As rmw_zenoh's own router: nodes learn of each other from it, and connect with each other.
        session, endpoint = open_router(listen, protection, {"scouting/gossip/enabled": True})
    else:
        session, endpoint, _ = open_connection(lambda: (router, None), clock, patience, {"timestamping/enabled": True})
    return Graph(session, endpoint, clock, NodeName(domain, str(session.zid()), 0, node))


class Graph:
    """One node. Endpoints are numbered in the order in which they are made."""

    def __init__(self, session: zenoh.Session, endpoint: str, clock: Clock, node: NodeName) -> None:
        self.endpoint = endpoint
        """Where the session listens, or is connected."""
        self.clock = clock
        self.node = node
        self._session = session
        self._next_number = node.number + 1
        self._declared: list[Any] = [session.liveliness().declare_token(node.token)]
        self._arrived: SimpleQueue[Any] = SimpleQueue()
        """Samples and queries; None at the end."""
        self._into_queue = zenoh.handlers.Callback(self._arrived.put, indirect=False)
        self._handlers: dict[str, list[Callable[[Any], None]]] = {}
        """Key → what handles that which arrives on it."""
        self._watches: list[tuple[zenoh.KeyExpr, Callable[[Any], None]]] = []
        """Keys of tokens, and what handles those that come and go."""
        self._thread = threading.Thread(target=self._handle, name=f"graph of {node.name}", daemon=True)
        self._thread.start()

    def publisher(self, topic: str, topic_type: TopicType) -> "GraphPublisher":
        """A publisher, of encoded messages."""
        token = self._declare(Kind.PUBLISHER, topic, topic_type)
        key = data_key(self.node.domain, topic, topic_type, hash_of(topic_type))
        writer: Any
        if topic_type.latched:
            writer = ext.declare_advanced_publisher(
                self._session,
                key,
                cache=ext.CacheConfig(max_samples=topic_type.depth),
                sample_miss_detection=ext.MissDetectionConfig(heartbeat=None, sporadic_heartbeat=HEARTBEAT_S),
                publisher_detection=True,
                congestion_control=zenoh.CongestionControl.DROP,
            )
        else:
            writer = self._session.declare_publisher(key, congestion_control=zenoh.CongestionControl.DROP)
        return GraphPublisher(writer, gid_of(token), self.clock, is_latched=topic_type.latched)

    def subscribe(self, topic: str, topic_type: TopicType, receive: Callable[[Arrived], None]) -> None:
        """Subscribe; `receive` is called for each message."""
        self._declare(Kind.SUBSCRIPTION, topic, topic_type)
        key = data_key(self.node.domain, topic, topic_type, hash_of(topic_type))

        def on_sample(sample: zenoh.Sample) -> None:
            receive(Arrived(sample.payload.to_bytes(), _attachment_of(sample)))

        if self._handle_by(key, on_sample):
            self._declared.append(self._session.declare_subscriber(key, self._into_queue))

    def serve(self, service: str, topic_type: TopicType, answer: Callable[["Request"], None]) -> None:
        """Serve; `answer` is called for each request, and replies at once or later."""
        self._declare(Kind.SERVICE, service, topic_type)
        key = data_key(self.node.domain, service, topic_type, hash_of(topic_type))

        def on_query(query: zenoh.Query) -> None:
            attachment = _attachment_of(query)
            if attachment is not None and query.payload is not None:
                answer(Request(query, key, query.payload.to_bytes(), attachment, self.clock))

        if self._handle_by(key, on_query):  # clients ask complete queryables only
            self._declared.append(self._session.declare_queryable(key, self._into_queue, complete=True))

    def watch(self, topic: str, kind: Kind, change: Callable[[Endpoint, bool], None]) -> None:
        """Watch who publishes or subscribes to a topic, of whatever type; begins with those that are there.

        `change` is called with each endpoint that comes (True) or goes (False).
        """

        def on_sample(sample: zenoh.Sample) -> None:
            endpoint = endpoint_of(str(sample.key_expr))
            if endpoint is not None:
                change(endpoint, sample.kind == zenoh.SampleKind.PUT)

        key = tokens_of(self.node.domain, topic, kind)
        self._watches.append((zenoh.KeyExpr(key), on_sample))
        self._declared.append(self._session.liveliness().declare_subscriber(key, self._into_queue, history=True))

    def close(self) -> None:
        """Leave the graph."""
        self._session.close()  # type: ignore[no-untyped-call]
        self._arrived.put(None)
        if self._thread is not threading.current_thread():
            self._thread.join()

    def __enter__(self) -> "Graph":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _handle_by(self, key: str, handler: Callable[[Any], None]) -> bool:
        """Handle by this what arrives on a key; whether it is the first handler of the key."""
        handlers = self._handlers.setdefault(key, [])
        handlers.append(handler)
        return len(handlers) == 1

    def _handle(self) -> None:
        """Handle what arrives until the end."""
        while (arrived := self._arrived.get()) is not None:
            if self._arrived.qsize() > _BACKLOG:
                continue
            key = arrived.key_expr
            handlers = self._handlers.get(str(key)) or [one for keys, one in self._watches if keys.includes(key)]
            for handler in handlers:
                try:
                    handler(arrived)
                except Exception:  # a fault of one callback must not silence the graph
                    log_line(traceback.format_exc(), Level.ERROR)

    def _declare(self, kind: Kind, topic: str, topic_type: TopicType) -> str:
        token = self.node.endpoint_token(self._next_number, kind, topic, topic_type, hash_of(topic_type))
        self._next_number += 1
        self._declared.append(self._session.liveliness().declare_token(token))
        return token


class GraphPublisher:
    """Publishes on one topic; may be used by several threads."""

    def __init__(self, writer: Any, gid: bytes, clock: Clock, *, is_latched: bool) -> None:
        self.gid = gid
        self._writer, self._clock = writer, clock
        self.is_read = True
        """Whether anybody subscribes, or may later and get the messages of today."""
        self._sequence = 0
        self._lock = threading.Lock()
        if not is_latched:
            self._matching = writer.declare_matching_listener(lambda _: self._match())
            self._match()

    def _match(self) -> None:
        with self._lock:  # the status of now, whichever thread comes last
            self.is_read = bool(self._writer.matching_status.matching)

    def put(self, payload: bytes | memoryview) -> None:
        """Publish an encoded message, without waiting for subscribers.

        Raises:
            BusError: the graph is closed.
        """
        with self._lock:
            self._sequence += 1
            attachment = Attachment(self._sequence, self._clock.unix_ns(), self.gid).pack()
            try:
                self._writer.put(bytes(payload), attachment=attachment)
            except zenoh.ZError as error:
                raise BusError(f"this graph is closed ({first_line(error)})") from None


class Request:
    """A request to a service, which waits for its reply."""

    def __init__(self, query: zenoh.Query, key: str, payload: bytes, attachment: Attachment, clock: Clock) -> None:
        self.payload = payload
        self._query, self._key, self._attachment, self._clock = query, key, attachment, clock

    def reply(self, payload: bytes | memoryview) -> None:
        """Send the encoded reply; once."""
        attachment = self._attachment._replace(sent_ns=self._clock.unix_ns()).pack()
        self._query.reply(self._key, bytes(payload), attachment=attachment)
        self._query.drop()  # type: ignore[no-untyped-call]


def _attachment_of(sample: Any) -> Attachment | None:
    raw = sample.attachment
    return Attachment.unpack(raw.to_bytes()) if raw is not None else None
