"""Queries to publishers' caches over Zenoh, for messages that Zenoh's own recovery has not delivered."""

from collections.abc import Callable
from queue import Empty, SimpleQueue

import zenoh

from schemas.bus.contract import ReceivedMessage
from schemas.bus.gap_recovery import Gap, GapRecovery
from schemas.bus.zenoh.session import SessionContext

_REPLY_S = 5.0
"""Longest wall time for the reply of a cache."""
_CACHE = "/@adv/pub/"
"""Stands between a key and the identity of its publisher in the key of a cache; `_sn` selects sequence numbers."""


class CacheQueries:
    """The cache queries of one subscription: takes samples, and returns messages in the order of their numbers."""

    def __init__(
        self,
        context: SessionContext,
        recovery: GapRecovery,
        read: Callable[[zenoh.Sample], ReceivedMessage | None],
        wake: Callable[[], None],
    ) -> None:
        """`read` returns the message in a sample; `wake` is called at the end of a reply."""
        self._context, self._recovery, self._read, self._wake = context, recovery, read, wake
        self._replies: SimpleQueue[tuple[Gap, list[zenoh.Sample]]] = SimpleQueue()
        self.accept_if_next = self._recovery.accept_if_next
        self.due_at = self._recovery.due_at

    def insert(self, received: ReceivedMessage, sample: zenoh.Sample) -> None:
        """Add a message that is not the next of its key."""
        self._recovery.insert(received, _writer_of(sample), self._context.clock.now())

    def next(self) -> ReceivedMessage | None:
        """The next message in order; missing messages are requested on the way."""
        if self._recovery.has_gaps or not self._replies.empty():
            self._recover()
        ready = self._recovery.ready
        return ready.popleft() if ready else None

    def _recover(self) -> None:
        now = self._context.clock.now()
        while True:
            try:
                gap, samples = self._replies.get_nowait()
            except Empty:
                break
            found = [received for sample in samples if (received := self._read(sample)) is not None]
            self._recovery.insert_reply(gap, found, now)
        for gap in self._recovery.due_requests(now):
            self._request(gap)

    def _request(self, gap: Gap) -> None:
        samples: list[zenoh.Sample] = []

        def receive(reply: zenoh.Reply) -> None:
            if reply.ok is not None:
                samples.append(reply.ok)

        def end() -> None:
            self._replies.put((gap, samples))
            self._wake()

        self._context.session.get(
            f"{self._context.prefix}{gap.key}{_CACHE}{gap.writer}/**?_sn={gap.first}..{gap.last}",
            zenoh.handlers.Callback(receive, end, indirect=False),
            target=zenoh.QueryTarget.ALL,
            consolidation=zenoh.ConsolidationMode.NONE,
            accept_replies=zenoh.ReplyKeyExpr.ANY,
            timeout=_REPLY_S,
        )


def _writer_of(sample: zenoh.Sample) -> str | None:
    """The identity of a sample's publisher in the key of its cache; None for a sample without one."""
    source = sample.source_info
    return f"{source.source_id.zid}/{source.source_id.eid}" if source is not None else None
