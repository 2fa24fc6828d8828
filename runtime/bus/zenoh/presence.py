"""Liveliness tokens over Zenoh."""

import zenoh

from runtime.bus.contract import Presence, PresenceKind, PresenceWatch
from runtime.bus.zenoh.session import SessionContext
from schemas.topics import TOPICS
from schemas.wire.message import is_name

NO_NAME = "the token of a process without a valid name"
"""Why a token is refused."""
_KINDS = frozenset(kind.value for kind in PresenceKind)


class ZenohPresenceWatch(PresenceWatch):
    def __init__(self, context: SessionContext) -> None:
        super().__init__()
        start = len(context.prefix)
        row = TOPICS["alive"]

        def receive(sample: zenoh.Sample) -> None:
            key = str(sample.key_expr)[start:]
            chunks = row.match(key)
            if chunks is None or chunks["kind"] not in _KINDS:
                return  # of a kind that a newer program may know
            if not is_name(chunks["name"]):
                context.owner.refusals.add(row.fill(kind=chunks["kind"]), NO_NAME)
            else:
                alive = sample.kind == zenoh.SampleKind.PUT
                self.mailbox.put(Presence(PresenceKind(chunks["kind"]), chunks["name"], alive))

        self._watch = context.session.liveliness().declare_subscriber(
            context.prefix + row.fill(), zenoh.handlers.Callback(receive, indirect=False), history=True
        )
