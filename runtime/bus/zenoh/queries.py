"""Queries and replies over Zenoh. They are rare, and wait in mailboxes."""

from contextlib import suppress

import zenoh

from runtime.bus.contract import NoReplyError, PendingReply, Query, RefusedQueryError, Server
from runtime.bus.refusals import NO_KEY
from runtime.bus.zenoh.session import SessionContext
from schemas.topic import Topic
from schemas.wire.message import Message

_EXPIRED = "Timeout"
"""Zenoh's own text in place of a reply that did not come in time."""
MAX_WAITING = 64
"""Most queries of one topic that wait; those beyond it are dropped, as when no process answers."""
TOO_MANY = "too many queries wait"
"""Why a query is dropped."""


class ZenohQuery(Query):
    def __init__(self, topic: Topic, key: str, query: zenoh.Query) -> None:
        super().__init__(topic, key, query.payload.to_bytes() if query.payload is not None else b"")
        self._query = query

    def reply_payload(self, payload: bytes) -> None:
        with self._query as query, suppress(zenoh.ZError):  # its client has gone
            query.reply(query.key_expr, payload, encoding=zenoh.Encoding.APPLICATION_JSON)

    def fail(self, reason: str) -> None:
        with self._query as query, suppress(zenoh.ZError):  # its client has gone
            query.reply_err(reason)


class ZenohServer(Server):
    def __init__(self, topic: Topic, key: str, context: SessionContext) -> None:
        super().__init__()
        start = len(context.prefix)

        def receive(query: zenoh.Query) -> None:
            asked = str(query.key_expr)[start:]
            reason = "" if topic.has_key(asked) else NO_KEY
            if not reason and len(self.mailbox) >= MAX_WAITING:
                reason = TOO_MANY
            if reason:
                context.owner.refusals.add(asked, reason)
                with query:
                    pass  # ends it without a reply
            else:
                self.mailbox.put(ZenohQuery(topic, asked, query))

        self._queryable = context.session.declare_queryable(
            context.prefix + key, zenoh.handlers.Callback(receive, indirect=False)
        )


class ZenohPendingReply(PendingReply):
    def __init__(
        self, topic: Topic, key: str, request: Message, timeout: float, droppable: bool, context: SessionContext
    ) -> None:
        super().__init__(topic, key)
        mailbox = self.mailbox

        def receive(reply: zenoh.Reply) -> None:
            if reply.ok is not None:
                mailbox.put(reply.ok.payload.to_bytes())
            elif reply.err is not None:
                reason = reply.err.payload.to_string()
                mailbox.put(NoReplyError(reason) if reason == _EXPIRED else RefusedQueryError(reason))

        def end() -> None:
            mailbox.put(NoReplyError(f"no process answers {key}"))

        context.session.get(
            context.prefix + key,
            zenoh.handlers.Callback(receive, end, indirect=False),
            payload=request.encode(),
            timeout=timeout,
            congestion_control=zenoh.CongestionControl.DROP if droppable else zenoh.CongestionControl.BLOCK,
        )
