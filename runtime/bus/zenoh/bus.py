"""The bus over Zenoh: the host is the router, and all other processes are clients with one explicit endpoint."""

import atexit
import weakref
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import zenoh

from runtime.access.accounts import Account
from runtime.access.credentials import Credentials, read_credentials
from runtime.access.protection import Protection
from runtime.access.rights import writers_of
from runtime.bus.contract import (
    Bus,
    BusError,
    PendingReply,
    PresenceKind,
    PresenceWatch,
    Publisher,
    Server,
    Subscription,
    check_publishable,
    full_key,
    full_keys,
)
from runtime.bus.endpoint import is_cut_off
from runtime.bus.mailbox import Mailbox
from runtime.bus.zenoh.match_at import hosts_of, match_at, other_match
from runtime.bus.zenoh.newest import ZenohNewest
from runtime.bus.zenoh.presence import ZenohPresenceWatch
from runtime.bus.zenoh.queries import ZenohPendingReply, ZenohServer
from runtime.bus.zenoh.reader import ZenohReader
from runtime.bus.zenoh.session import SessionContext, open_connection, open_router
from runtime.bus.zenoh.several import ZenohSeveral
from runtime.bus.zenoh.stream import ZenohPublisher, ZenohSubscription
from runtime.bus.zenoh.wait_timer import WaitTimer
from runtime.process.clock import Clock
from runtime.process.timing import RECONNECT_S, REQUEST_S
from schemas.topic import Delivery, Topic
from schemas.topics import TOPICS, key_prefix
from schemas.wire.message import Message


def open_host(
    match: str,
    clock: Clock,
    listen: str | None = None,
    protection: Protection | None = None,
    limits: Mapping[str, object] | None = None,
) -> "ZenohBus":
    """Open the host's bus: a router that listens on one endpoint, the bus's `endpoint`; all as in `open_router`."""
    session, endpoint = open_router(listen, protection, limits)
    return ZenohBus(match, clock, session, endpoint, is_client=False)


def open_client(
    match: str | None,
    clock: Clock,
    connect: str | None = None,
    patience: float = RECONNECT_S,
    credentials: Path | None = None,
    account: Account | None = None,
    *,
    any_match: bool = False,
) -> "ZenohBus":
    """Open a client's bus, with attempts for `patience` s of wall time.

    With `any_match` it is the bus of the only match at the endpoint even if that has another name, for clients that the
    host is to refuse.

    Without an endpoint it connects to the running match of this machine, without a name to the match at the endpoint.

    Args:
        credentials: file of the credentials; None takes those of `account` that the running match has announced.

    Raises:
        TouchlineError: no endpoint is given, and several matches run on this machine.
        BusError: no host admits this client at the endpoint, or no match is played there.
    """
    given = read_credentials(credentials) if credentials is not None else None
    if given is not None:
        match, connect = match or given.match, connect or given.connect
    deadline = clock.now() + patience

    def find() -> tuple[str, Credentials | None]:
        if given is not None and connect is not None:
            return connect, given
        endpoint, announced = _announced(match, connect, account if given is None else None)
        return endpoint, given or announced

    session, endpoint, known = open_connection(find, clock, patience)
    try:
        name = match_at(session, endpoint, clock, deadline) if match is None else match
        until = deadline if any_match else clock.now()  # a router accepts clients before its host is present
        if match is not None and match not in (others := hosts_of(session, clock, until)) and others:
            if not any_match or len(others) > 1:
                raise BusError(other_match(endpoint, match, others))
            (name,) = others
    except BaseException:
        session.close()  # type: ignore[no-untyped-call]
        raise
    return ZenohBus(name, clock, session, endpoint, is_client=True, account=known.user if known is not None else None)


def _announced(match: str | None, connect: str | None, account: Account | None) -> tuple[str, Credentials | None]:
    """The endpoint of the running match, by default the given one, and the credentials that it has for an account."""
    if connect is not None and account is None:
        return connect, None
    from runtime.bus.find_host import find_host  # needs file locks, which not every system of a robot has

    found = find_host(match, connect)
    return found.endpoint, found.credentials_of(account) if account is not None else None


class ZenohBus(Bus):
    """A bus on a Zenoh network."""

    def __init__(
        self,
        match: str,
        clock: Clock,
        session: zenoh.Session,
        endpoint: str,
        *,
        is_client: bool,
        account: Account | None = None,
    ) -> None:
        super().__init__(match, clock)
        self.account = account
        self.session = session
        self.endpoint = endpoint
        """Where the host listens; of a client, where it is connected."""
        self._context = SessionContext(session, key_prefix(match), clock, is_client, WaitTimer(clock), self)
        self._mailboxes: list[Mailbox[Any]] = []
        self._subscriptions: list[ZenohReader] = []
        self._tokens: dict[str, zenoh.LivelinessToken] = {}
        _OPEN.add(self)

    def publisher(self, topic: Topic, **chunks: str) -> Publisher:
        check_publishable(topic)
        self._check_may_write(topic)
        return ZenohPublisher(topic, full_key(topic, chunks), self._open())

    def subscribe(self, topic: Topic, *, newest: bool = False, history: bool = False, **chunks: str) -> Subscription:
        check_publishable(topic)
        context, key = self._open(), topic.fill(**{**self._own_side(topic), **chunks})
        newest = newest or topic.delivery is Delivery.NEWEST
        subscription: ZenohReader
        if newest and "*" not in key:
            subscription = ZenohNewest(topic, key, context)
        else:
            subscription = ZenohSubscription(topic, key, context, newest, history)
        self._subscriptions.append(subscription)
        context.timer.add(subscription)
        return subscription

    def subscribe_each(self, topic: Topic, **chunks: Sequence[str]) -> Subscription:
        check_publishable(topic)
        subscription = ZenohSeveral(topic, full_keys(topic, chunks), self._open())
        self._subscriptions.append(subscription)
        return subscription

    def serve(self, topic: Topic, **chunks: str) -> Server:
        server = ZenohServer(topic, topic.fill(**chunks), self._open())
        self._mailboxes.append(server.mailbox)
        return server

    def query(
        self, topic: Topic, request: Message, timeout: float = REQUEST_S, *, droppable: bool = False, **chunks: str
    ) -> PendingReply:
        self._check_may_write(topic)
        return ZenohPendingReply(topic, full_key(topic, chunks), request, timeout, droppable, self._open())

    def declare_alive(self, kind: PresenceKind, name: str) -> None:
        key = self._context.prefix + TOPICS["alive"].fill(kind=kind, name=name)
        if key not in self._tokens:
            self._tokens[key] = self._open().session.liveliness().declare_token(key)

    def withdraw_alive(self, kind: PresenceKind, name: str) -> None:
        self._open()
        token = self._tokens.pop(self._context.prefix + TOPICS["alive"].fill(kind=kind, name=name), None)
        if token is not None:
            token.undeclare()  # type: ignore[no-untyped-call]

    def watch_alive(self) -> PresenceWatch:
        watch = ZenohPresenceWatch(self._open())
        self._mailboxes.append(watch.mailbox)
        return watch

    def connected(self) -> bool:
        if self._closed:
            return False
        return not self._context.is_client or bool(self.session.info.routers_zid())

    def is_cut_off(self) -> bool:
        return self._context.is_client and not self.connected() and is_cut_off(self.endpoint)

    def close(self) -> None:
        if self._closed:
            return
        self._closed = True
        self._context.timer.stop()
        for subscription in self._subscriptions:
            subscription.end()
        for mailbox in self._mailboxes:
            mailbox.close()
        try:
            self.session.close()  # type: ignore[no-untyped-call]
        except zenoh.ZError:
            return  # the peer has closed it

    def _check_may_write(self, topic: Topic) -> None:
        """Report what the host would drop without a notice."""
        if self.account is not None and self.account not in (known := writers_of(topic)):
            files = " or ".join(f"{account.value}.json" for account in known)
            raise BusError(f"the account {self.account.value} may not send {topic.key}; use --credentials with {files}")

    def _own_side(self, topic: Topic) -> dict[str, str]:
        """The side of a coach, whose subscription to both sides' keys the host would drop."""
        side = self.account.side if self.account is not None else None
        return {"side": side.value} if side is not None and "side" in topic.chunks else {}

    def _open(self) -> SessionContext:
        if self._closed:
            raise BusError("this bus is closed")
        return self._context


_OPEN: "weakref.WeakSet[ZenohBus]" = weakref.WeakSet()


@atexit.register
def _close_all() -> None:
    """Close before the interpreter shuts down: a process that watches presence hangs at exit with an open session."""
    for bus in list(_OPEN):
        bus.close()
