"""Keeps the messages of a key in their order until what is missing has come, or is known to be gone for good.

Zenoh asks a writer's cache for what a reader missed, and goes on without it as soon as that request ends: also when
the link broke in the middle of the answer, or when more was dropped while it came. What it leaves missing is asked for
here again. Knows no network: `zenoh.cache_queries` sends the requests.
"""

import math
from collections import deque
from collections.abc import Iterable
from typing import NamedTuple

from schemas.bus.contract import ReceivedMessage, Stamp

RETRY_S = 0.2
"""Wall time between an answer that was cut off and the next request."""
GIVE_UP_S = 20.0
"""Wall time after which what is missing is waited for no more: longer than any link takes that comes back."""
LOOKBACK = 100
"""Messages of a key that are asked for before the first that came: as many as go missing while a link is busy."""


class Gap(NamedTuple):
    """What is to be asked for: of one writer's messages on one key, those from `first` to `last`, both included.

    The last of them has come already: an answer in which it stands was not cut off.
    """

    key: str
    writer: str
    first: int
    last: int


class _Stream:
    """One writer's messages on one key."""

    __slots__ = ("expected", "give_up_at", "held", "requested", "retry_at", "writer")

    def __init__(self, writer: str, expected: int) -> None:
        self.writer = writer
        self.expected = expected
        self.held: dict[int, ReceivedMessage] = {}
        self.requested = False
        self.retry_at = self.give_up_at = 0.0

    @property
    def due_at(self) -> float:
        """When it is asked for, or given up."""
        return self.give_up_at if self.requested else min(self.retry_at, self.give_up_at)


class GapRecovery:
    """Puts messages into the order of their numbers; times are wall time in s."""

    def __init__(self, since_ns: int, lookback: int = LOOKBACK) -> None:
        """Before the first message of a key that comes, up to `lookback` others are asked for: nobody could see a gap
        there. Of these, what was sent before `since_ns` (wall time) is not wanted.
        """
        self._since_ns, self._lookback = since_ns, lookback
        self.ready: deque[ReceivedMessage] = deque()
        """What is in order, to be taken from the left."""
        self._streams: dict[str, _Stream] = {}
        self._with_gaps: dict[str, _Stream] = {}
        """The streams with a gap."""

    def accept_if_next(self, received: ReceivedMessage) -> bool:
        """Whether a message that has come is the next of its key, and nothing is held back: most are."""
        stamp, stream = received.stamp, self._streams.get(received.key)
        if stream is None or stamp is None or stamp.sequence != stream.expected or stream.held:
            return False
        stream.expected += 1
        return True

    def insert(self, received: ReceivedMessage, writer: str | None, now: float) -> None:
        """A message has come that does not pass, of this writer; nobody can be asked where that is not known."""
        stamp, key = received.stamp, received.key
        stream = self._streams.get(key)
        if stamp is None or writer is None:
            self.ready.append(received)
        else:
            if stream is None or stream.writer != writer:
                self._skip_all(key)
                stream = self._streams[key] = _Stream(writer, self._first_of(stamp))
            if stamp.sequence < stream.expected:
                self.ready.append(received)  # a double; who keeps account will see it
                return
            if not stream.held:
                stream.retry_at, stream.give_up_at = now, now + GIVE_UP_S
                self._with_gaps[key] = stream
            stream.held[stamp.sequence] = received
            self._advance(key, stream)

    @property
    def has_gaps(self) -> bool:
        """Whether something is missing."""
        return bool(self._with_gaps)

    def due_at(self) -> float:
        """When there is something to ask for, or to give up; infinite while nothing is missing."""
        return min((stream.due_at for stream in self._with_gaps.values()), default=math.inf)

    def due_requests(self, now: float) -> list[Gap]:
        """What is to be asked for now; each is answered by `insert_reply`."""
        gaps = []
        for key, stream in list(self._with_gaps.items()):
            if now >= stream.give_up_at:
                self._skip(key, stream)
                stream.give_up_at = now + GIVE_UP_S
            elif not stream.requested and now >= stream.retry_at:
                stream.requested = True
                gaps.append(Gap(key, stream.writer, stream.expected, min(stream.held)))
        return gaps

    def insert_reply(self, gap: Gap, found: Iterable[ReceivedMessage], now: float) -> None:
        """The reply to a request has ended, whole or cut off."""
        stream = self._streams.get(gap.key)
        if stream is None or stream.writer != gap.writer:
            return
        stream.requested, stream.retry_at = False, now + RETRY_S
        expected, whole = stream.expected, False
        for received in found:
            if received.stamp is not None:
                number = received.stamp.sequence
                whole = whole or number == gap.last
                if self._is_wanted(received.stamp, stream):
                    stream.held.setdefault(number, received)
        self._advance(gap.key, stream)
        if whole and stream.expected < gap.last:
            self._skip(gap.key, stream)  # the writer keeps it no more, or nobody wants it
        if stream.expected > expected:
            stream.give_up_at = now + GIVE_UP_S

    def _first_of(self, stamp: Stamp) -> int:
        """The number to begin a key with whose first message that came has this stamp."""
        return max(0, stamp.sequence - self._lookback) if stamp.sent_ns >= self._since_ns else stamp.sequence

    def _is_wanted(self, stamp: Stamp, stream: _Stream) -> bool:
        return stamp.sequence >= stream.expected and stamp.sent_ns >= self._since_ns

    def _skip_all(self, key: str) -> None:
        while (stream := self._with_gaps.get(key)) is not None:
            self._skip(key, stream)

    def _skip(self, key: str, stream: _Stream) -> None:
        """Go on behind a gap."""
        stream.expected = min(stream.held)
        self._advance(key, stream)

    def _advance(self, key: str, stream: _Stream) -> None:
        held = stream.held
        while (received := held.pop(stream.expected, None)) is not None:
            stream.expected += 1
            self.ready.append(received)
        if not held:
            self._with_gaps.pop(key, None)
