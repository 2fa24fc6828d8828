"""Any keys of a Zenoh network, with or without a match: payloads of any encoding, as they are."""

from pathlib import Path
from typing import Any, NamedTuple

import zenoh

from runtime.access.credentials import Credentials, read_credentials
from runtime.access.protection import Protection
from runtime.bus.contract import BusError, Stamp
from runtime.bus.zenoh.bus import ZenohBus, open_host
from runtime.bus.zenoh.reader import STAMP
from runtime.bus.zenoh.session import first_line, open_connection
from runtime.process.clock import Clock
from runtime.process.timing import RECONNECT_S

_BACKLOG = 500_000
"""Most samples that wait to be read; then the network waits, or its publishers drop."""
_AT_ONCE = 1000
STAMPED = "stamp"
"""Stands for the writer of a sample that the stamp of this project numbers."""
_SEQUENCES = 1 << 32
"""Zenoh has sequence numbers of 32 bits."""


class Sample(NamedTuple):
    """A payload that was put on a key."""

    key: str
    payload: bytes
    encoding: str
    """As Zenoh names it: `application/cdr;geometry_msgs/msg/Twist`."""
    sent_ns: int
    """Wall time of its stamp, ns since 1970; 0 without one."""
    writer: str
    """Who numbered it, `STAMPED` if the stamp does not say; empty if it has no number."""
    sequence: int


def open_network(
    name: str,
    clock: Clock,
    connect: str | None,
    listen: str | None,
    credentials: Path | None = None,
    patience: float = RECONNECT_S,
    protection: Protection | None = None,
) -> ZenohBus:
    """A bus named `name` on any network: a client of the router or peer at `connect`, or a router at `listen`.

    A client joins with `credentials`, a router has `protection`, each None without.

    Raises:
        BusError: nothing answers at `connect`, or `listen` cannot be listened on.
    """
    if connect is None:
        return open_host(name, clock, listen, protection)
    known: Credentials | None = read_credentials(credentials) if credentials is not None else None
    session, endpoint, _ = open_connection(lambda: (connect, known), clock, patience)
    return ZenohBus(name, clock, session, endpoint, is_client=True)


def check_key(key: str) -> None:
    """Check that something can be put on a key.

    Raises:
        BusError: it is no key of Zenoh, or stands for several.
    """
    try:
        is_key = not any(sign in str(zenoh.KeyExpr(key)) for sign in "*$")
    except zenoh.ZError:
        is_key = False
    if not is_key:
        raise BusError(f'"{key}" cannot be a key of Zenoh, with empty chunks or one of * $ # ?')


class KeyPublisher:
    """Puts payloads of one encoding on one key, numbered from 0. It waits for slow subscribers."""

    def __init__(self, bus: ZenohBus, key: str, encoding: str) -> None:
        self._publisher = bus.session.declare_publisher(
            key, encoding=encoding, congestion_control=zenoh.CongestionControl.BLOCK
        )
        self._source, self._sequence = self._publisher.id, 0

    def put(self, payload: bytes) -> None:
        """Put a payload."""
        self._publisher.put(payload, source_info=zenoh.SourceInfo(self._source, self._sequence % _SEQUENCES))
        self._sequence += 1


class KeySubscription:
    """The samples of all keys that key expressions match, in order of arrival."""

    def __init__(self, bus: ZenohBus, expressions: list[str]) -> None:
        """Subscribe.

        Raises:
            BusError: an expression is none of Zenoh.
        """
        self._subscribers: list[tuple[zenoh.KeyExpr, Any]] = []
        self._arrived: list[Any] = []
        """The channel of each subscriber, which outlives it."""
        self._owners: dict[str, int] = {}
        """Key → number of the subscriber that reads it, the first of those that match."""
        for expression in expressions:
            try:
                subscriber = bus.session.declare_subscriber(expression, zenoh.handlers.FifoChannel(_BACKLOG))
            except zenoh.ZError as error:
                raise BusError(
                    f'--keys "{expression}" is no key expression ({first_line(error)}); write it as robot/**'
                ) from None
            self._subscribers.append((zenoh.KeyExpr(expression), subscriber))
            self._arrived.append(subscriber.handler)

    def close(self) -> None:
        """Let nothing more arrive. What has arrived can still be received."""
        for _, subscriber in self._subscribers:
            subscriber.undeclare()

    def receive(self) -> list[Sample]:
        """What has arrived, in order on each key; at most a thousand samples of each expression, none if it was all."""
        found: list[Sample] = []
        for number, arrived in enumerate(self._arrived):
            most = len(found) + _AT_ONCE
            while len(found) < most and (sample := _next(arrived)) is not None:
                if sample.kind == zenoh.SampleKind.PUT and self._owner(str(sample.key_expr)) == number:
                    found.append(_sample(sample))
        return found

    def _owner(self, key: str) -> int:
        if key not in self._owners:
            expressions = enumerate(expression for expression, _ in self._subscribers)
            self._owners[key] = next(number for number, one in expressions if one.intersects(zenoh.KeyExpr(key)))
        return self._owners[key]


def _next(arrived: Any) -> Any:
    """The next sample of a channel; None if there is none."""
    try:
        return arrived.try_recv()
    except zenoh.ZError:
        return None  # its subscriber is closed


def _sample(sample: zenoh.Sample) -> Sample:
    """Its number is that of Zenoh's source information, or of the stamp that this project attaches."""
    writer, sequence, sent_ns = "", 0, 0
    source, attachment = sample.source_info, sample.attachment
    raw = attachment.to_bytes() if attachment is not None else b""
    if source is not None:
        writer, sequence = f"{source.source_id.zid}/{source.source_id.eid}", source.source_sn
    if sample.timestamp is not None:
        sent_ns = sample.timestamp.get_time_as_ntp64().as_nanos()
    if len(raw) == STAMP.size:
        stamp = Stamp(*STAMP.unpack(raw))
        writer, sequence, sent_ns = STAMPED, stamp.sequence, stamp.sent_ns
    return Sample(str(sample.key_expr), sample.payload.to_bytes(), str(sample.encoding), sent_ns, writer, sequence)
