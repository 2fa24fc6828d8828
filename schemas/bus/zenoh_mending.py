"""Asks the writers' caches over Zenoh for what Zenoh's own recovery left missing."""

from collections.abc import Callable
from queue import Empty, SimpleQueue

import zenoh

from schemas.bus.contract import Received
from schemas.bus.mending import Gap, Mender
from schemas.bus.session import Seat

_ANSWER_S = 5.0
"""Wall time that a cache may take to answer."""
_CACHE = "/@adv/pub/"
"""Between a key and the identity of its writer: where a writer's cache is asked. `_sn` names the numbers wanted."""


class ZenohMending:
    """Of one subscription: samples in, messages in the order of their numbers out."""

    def __init__(
        self, seat: Seat, mender: Mender, read: Callable[[zenoh.Sample], Received | None], wake: Callable[[], None]
    ) -> None:
        """`read` makes a message of a sample; `wake` is called when an answer has ended."""
        self._seat, self._mender, self._read, self._wake = seat, mender, read, wake
        self._answers: SimpleQueue[tuple[Gap, list[zenoh.Sample]]] = SimpleQueue()
        self.passes = self._mender.passes
        self.due_at = self._mender.due_at
        self.forgo = self._mender.forgo

    def take(self, received: Received, sample: zenoh.Sample) -> None:
        """A message that does not pass."""
        self._mender.take(received, _writer_of(sample), self._seat.clock.now())

    def next(self) -> Received | None:
        """A message whose turn has come; what is missing is asked for on the way."""
        if self._mender.is_broken or not self._answers.empty():
            self._mend()
        ready = self._mender.ready
        return ready.popleft() if ready else None

    def _mend(self) -> None:
        now = self._seat.clock.now()
        while True:
            try:
                gap, samples = self._answers.get_nowait()
            except Empty:
                break
            found = [received for sample in samples if (received := self._read(sample)) is not None]
            self._mender.answered(gap, found, now)
        for gap in self._mender.questions(now):
            self._ask(gap)

    def _ask(self, gap: Gap) -> None:
        samples: list[zenoh.Sample] = []

        def bring(reply: zenoh.Reply) -> None:
            if reply.ok is not None:
                samples.append(reply.ok)

        def end() -> None:
            self._answers.put((gap, samples))
            self._wake()

        self._seat.session.get(
            f"{self._seat.prefix}{gap.key}{_CACHE}{gap.writer}/**?_sn={gap.first}..{gap.last}",
            zenoh.handlers.Callback(bring, end, indirect=False),
            target=zenoh.QueryTarget.ALL,
            consolidation=zenoh.ConsolidationMode.NONE,
            accept_replies=zenoh.ReplyKeyExpr.ANY,
            timeout=_ANSWER_S,
        )


def _writer_of(sample: zenoh.Sample) -> str | None:
    """Who has sent a sample, as its cache is asked; nothing where it says none."""
    source = sample.source_info
    return f"{source.source_id.zid}/{source.source_id.eid}" if source is not None else None
