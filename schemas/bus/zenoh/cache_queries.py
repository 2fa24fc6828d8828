"""Asks the writers' caches over Zenoh for what Zenoh's own recovery left missing."""

from collections.abc import Callable
from queue import Empty, SimpleQueue

import zenoh

from schemas.bus.contract import ReceivedMessage
from schemas.bus.gap_recovery import Gap, GapRecovery
from schemas.bus.zenoh.session import SessionContext

_ANSWER_S = 5.0
"""Wall time that a cache may take to answer."""
_CACHE = "/@adv/pub/"
"""Between a key and the identity of its writer: where a writer's cache is asked. `_sn` names the numbers wanted."""


class CacheQueries:
    """Of one subscription: samples in, messages in the order of their numbers out."""

    def __init__(
        self,
        context: SessionContext,
        recovery: GapRecovery,
        read: Callable[[zenoh.Sample], ReceivedMessage | None],
        wake: Callable[[], None],
    ) -> None:
        """`read` makes a message of a sample; `wake` is called when an answer has ended."""
        self._context, self._recovery, self._read, self._wake = context, recovery, read, wake
        self._answers: SimpleQueue[tuple[Gap, list[zenoh.Sample]]] = SimpleQueue()
        self.accept_if_next = self._recovery.accept_if_next
        self.due_at = self._recovery.due_at

    def insert(self, received: ReceivedMessage, sample: zenoh.Sample) -> None:
        """A message that does not pass."""
        self._recovery.insert(received, _writer_of(sample), self._context.clock.now())

    def next(self) -> ReceivedMessage | None:
        """A message whose turn has come; what is missing is asked for on the way."""
        if self._recovery.has_gaps or not self._answers.empty():
            self._recover()
        ready = self._recovery.ready
        return ready.popleft() if ready else None

    def _recover(self) -> None:
        now = self._context.clock.now()
        while True:
            try:
                gap, samples = self._answers.get_nowait()
            except Empty:
                break
            found = [received for sample in samples if (received := self._read(sample)) is not None]
            self._recovery.insert_reply(gap, found, now)
        for gap in self._recovery.due_requests(now):
            self._ask(gap)

    def _ask(self, gap: Gap) -> None:
        samples: list[zenoh.Sample] = []

        def receive(reply: zenoh.Reply) -> None:
            if reply.ok is not None:
                samples.append(reply.ok)

        def end() -> None:
            self._answers.put((gap, samples))
            self._wake()

        self._context.session.get(
            f"{self._context.prefix}{gap.key}{_CACHE}{gap.writer}/**?_sn={gap.first}..{gap.last}",
            zenoh.handlers.Callback(receive, end, indirect=False),
            target=zenoh.QueryTarget.ALL,
            consolidation=zenoh.ConsolidationMode.NONE,
            accept_replies=zenoh.ReplyKeyExpr.ANY,
            timeout=_ANSWER_S,
        )


def _writer_of(sample: zenoh.Sample) -> str | None:
    """Who has sent a sample, as its cache is asked; nothing where it says none."""
    source = sample.source_info
    return f"{source.source_id.zid}/{source.source_id.eid}" if source is not None else None
