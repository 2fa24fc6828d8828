"""Queries, replies and liveliness tokens over Zenoh. They are rare, and wait in mailboxes."""

import zenoh

from schemas.bus.contract import (
    NoReplyError,
    PendingReply,
    Presence,
    PresenceKind,
    PresenceWatch,
    Query,
    Server,
)
from schemas.bus.mailbox import EveryMailbox
from schemas.bus.zenoh.session import SessionContext
from schemas.topic import Topic
from schemas.topics import TOPICS
from schemas.wire.message import WireMessage

_KINDS = frozenset(kind.value for kind in PresenceKind)


class ZenohQuery(Query):
    def __init__(self, topic: Topic, query: zenoh.Query) -> None:
        super().__init__(topic, topic.key, query.payload.to_bytes() if query.payload is not None else b"")
        self._query = query

    def reply(self, reply: WireMessage) -> None:
        self.reply_payload(reply.encode())

    def reply_payload(self, payload: bytes) -> None:
        with self._query as query:
            query.reply(query.key_expr, payload, encoding=zenoh.Encoding.APPLICATION_JSON)

    def fail(self, reason: str) -> None:
        with self._query as query:
            query.reply_err(reason)


class ZenohServer(Server):
    def __init__(self, topic: Topic, key: str, context: SessionContext) -> None:
        self.mailbox: EveryMailbox[Query] = EveryMailbox()

        def receive(query: zenoh.Query) -> None:
            self.mailbox.put("", ZenohQuery(topic, query))

        self._queryable = context.session.declare_queryable(
            context.prefix + key, zenoh.handlers.Callback(receive, indirect=False)
        )

    def receive(self, timeout: float | None = 0.0) -> Query | None:
        return self.mailbox.get(timeout)


class ZenohPendingReply(PendingReply):
    def __init__(
        self, topic: Topic, key: str, request: WireMessage, timeout: float, droppable: bool, context: SessionContext
    ) -> None:
        super().__init__(topic)
        self._key = key
        mailbox: EveryMailbox[bytes | str] = EveryMailbox()
        self._mailbox = mailbox

        def receive(reply: zenoh.Reply) -> None:
            if reply.ok is not None:
                mailbox.put("", reply.ok.payload.to_bytes())
            elif reply.err is not None:
                mailbox.put("", reply.err.payload.to_string())

        def end() -> None:
            mailbox.put("", f"no process answers {key}")

        context.session.get(
            context.prefix + key,
            zenoh.handlers.Callback(receive, end, indirect=False),
            payload=request.encode(),
            timeout=timeout,
            congestion_control=zenoh.CongestionControl.DROP if droppable else zenoh.CongestionControl.BLOCK,
        )

    def payload(self, timeout: float) -> bytes:
        reply = self._mailbox.get(timeout)
        if reply is None:
            raise NoReplyError(f"no process answers {self._key} within {timeout:g} s")
        if isinstance(reply, str):
            raise NoReplyError(reply)
        return reply


class ZenohWatch(PresenceWatch):
    def __init__(self, context: SessionContext) -> None:
        self.mailbox: EveryMailbox[Presence] = EveryMailbox()
        self.is_empty = self.mailbox.is_empty
        start = len(context.prefix)
        row = TOPICS["alive"]

        def receive(sample: zenoh.Sample) -> None:
            chunks = row.match(str(sample.key_expr)[start:])
            if chunks and chunks["kind"] in _KINDS:
                alive = sample.kind == zenoh.SampleKind.PUT
                self.mailbox.put("", Presence(PresenceKind(chunks["kind"]), chunks["name"], alive))

        self._watch = context.session.liveliness().declare_subscriber(
            context.prefix + row.fill(), zenoh.handlers.Callback(receive, indirect=False), history=True
        )

    def receive(self, timeout: float | None = 0.0) -> Presence | None:
        return self.mailbox.get(timeout)
