"""Holds back the messages of a key behind a gap until the missing ones arrive or are known to be lost.

Zenoh queries a publisher's cache for missed messages, and continues without them as soon as that query ends, even when
the link broke during the reply or more messages were dropped meanwhile. The rest is requested again here. This module
has no network access: `zenoh.cache_queries` sends the requests.
"""

import math
from collections import deque
from collections.abc import Iterable
from typing import NamedTuple

from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.recovery_window import GIVE_UP_S

RETRY_S = 0.2
"""Wall time between an incomplete reply and the next request."""
LOOKBACK = 100
"""Messages of a key that are requested before the first that arrived: as many as are lost while a link is busy."""


class Gap(NamedTuple):
    """A range of missing messages of one publisher on one key, from `first` to `last`, both included.

    The last of them has already arrived: a reply that contains it is complete.
    """

    key: str
    writer: str
    first: int
    last: int


class _Stream:
    """One publisher's messages on one key."""

    __slots__ = ("expected", "give_up_at", "held", "requested", "retry_at", "writer")

    def __init__(self, writer: str, expected: int) -> None:
        self.writer = writer
        self.expected = expected
        self.held: dict[int, ReceivedMessage] = {}
        self.requested = False
        self.retry_at = self.give_up_at = 0.0

    @property
    def due_at(self) -> float:
        """When its gap is requested next, or given up."""
        return self.give_up_at if self.requested else min(self.retry_at, self.give_up_at)


class GapRecovery:
    """Sorts messages by their sequence numbers; times are wall time in s."""

    def __init__(self, since_ns: int, lookback: int = LOOKBACK) -> None:
        """Before the first message of a key, where no gap is visible, up to `lookback` earlier ones are requested.

        Those that were sent before `since_ns` (wall time) are left out.
        """
        self._since_ns, self._lookback = since_ns, lookback
        self.ready: deque[ReceivedMessage] = deque()
        """Messages in order, to be taken from the left."""
        self._streams: dict[str, _Stream] = {}
        self._with_gaps: dict[str, _Stream] = {}
        """The streams with a gap."""

    def accept_if_next(self, received: ReceivedMessage) -> bool:
        """Whether an arrived message is the next of its key with none held back, as most are."""
        stamp, stream = received.stamp, self._streams.get(received.key)
        if stream is None or stamp is None or stamp.sequence != stream.expected or stream.held:
            return False
        stream.expected += 1
        return True

    def insert(self, received: ReceivedMessage, writer: str | None, now: float) -> None:
        """Add a message of this publisher that is not the next; without a publisher, its gap cannot be requested."""
        stamp, key = received.stamp, received.key
        stream = self._streams.get(key)
        if stamp is None or writer is None:
            self.ready.append(received)
        else:
            if stream is None or stream.writer != writer:
                self._skip_all(key)
                stream = self._streams[key] = _Stream(writer, self._first_of(stamp))
            if stamp.sequence < stream.expected:
                self.ready.append(received)  # a duplicate, which the caller counts
                return
            if not stream.held:
                stream.retry_at, stream.give_up_at = now, now + GIVE_UP_S
                self._with_gaps[key] = stream
            stream.held[stamp.sequence] = received
            self._advance(key, stream)

    @property
    def has_gaps(self) -> bool:
        """Whether messages are missing."""
        return bool(self._with_gaps)

    def due_at(self) -> float:
        """When the next gap is to be requested or given up; infinite without a gap."""
        return min((stream.due_at for stream in self._with_gaps.values()), default=math.inf)

    def due_requests(self, now: float) -> list[Gap]:
        """The gaps to request now; `insert_reply` takes the reply to each."""
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
        """Add the messages of a reply, complete or not."""
        stream = self._streams.get(gap.key)
        if stream is None or stream.writer != gap.writer:
            return
        stream.requested, stream.retry_at = False, now + RETRY_S
        expected, reply_complete = stream.expected, False
        for received in found:
            if received.stamp is not None:
                number = received.stamp.sequence
                reply_complete = reply_complete or number == gap.last
                if self._is_wanted(received.stamp, stream):
                    stream.held.setdefault(number, received)
        self._advance(gap.key, stream)
        if reply_complete and stream.expected < gap.last:
            self._skip(gap.key, stream)  # no longer in the cache, or older than wanted
        if stream.expected > expected:
            stream.give_up_at = now + GIVE_UP_S

    def _first_of(self, stamp: Stamp) -> int:
        """The first sequence number expected of a key whose first arrived message has this stamp."""
        return max(0, stamp.sequence - self._lookback) if stamp.sent_ns >= self._since_ns else stamp.sequence

    def _is_wanted(self, stamp: Stamp, stream: _Stream) -> bool:
        return stamp.sequence >= stream.expected and stamp.sent_ns >= self._since_ns

    def _skip_all(self, key: str) -> None:
        while (stream := self._with_gaps.get(key)) is not None:
            self._skip(key, stream)

    def _skip(self, key: str, stream: _Stream) -> None:
        """Continue behind a gap."""
        stream.expected = min(stream.held)
        self._advance(key, stream)

    def _advance(self, key: str, stream: _Stream) -> None:
        held = stream.held
        while (received := held.pop(stream.expected, None)) is not None:
            stream.expected += 1
            self.ready.append(received)
        if not held:
            self._with_gaps.pop(key, None)
