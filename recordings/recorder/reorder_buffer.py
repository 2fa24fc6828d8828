"""One order for the messages of many keys: by simulated time, each key in its own order, and the same in every run.

Robots answer in an order that no two runs share, a message may come late, and sights come on a way of their own. So all
are held for a moment and released tick by tick.
"""

from bisect import bisect_left
from collections.abc import Iterable
from operator import itemgetter

from schemas.bus.contract import ReceivedMessage
from schemas.topic import Party
from schemas.topics import SIGHT, TOPICS

_PLACES = {
    topic.key: place
    for place, topic in enumerate(
        row for row in TOPICS.values() if (row.recorded and row.writer is Party.HOST) or row is SIGHT
    )
}
"""Rows of the host's in the order in which their messages of one moment stand; all others come after them."""
_LAST = len(_PLACES)

QueuedMessage = tuple[int, int, str, int, ReceivedMessage]
"""A message behind its place: simulated time in ns, place of its row, key, and number on the key; sorts by these."""


_FIRST = (0, 0)


class ReorderBuffer:
    """Holds messages, and releases them in order."""

    def __init__(self) -> None:
        self._held: list[QueuedMessage] = []
        self._of_key: dict[str, tuple[int, int]] = {}
        self._host_ns = 0
        self._complete_ns: int | None = None
        self._released_ns = 0

    def __len__(self) -> int:
        return len(self._held)

    @property
    def host_ns(self) -> int:
        """The newest simulated time that the host has sent, in ns."""
        return self._host_ns

    @property
    def complete_ns(self) -> int:
        """Up to where the host's record batches have come, ns."""
        return self._host_ns if self._complete_ns is None else self._complete_ns

    def advance(self, batch: ReceivedMessage) -> None:
        """All that this record batch holds was taken in."""
        if batch.stamp is not None:
            self._complete_ns = max(self._complete_ns or 0, batch.stamp.sim_ns)
            self._host_ns = max(self._host_ns, batch.stamp.sim_ns)

    def note_host_time(self, received: ReceivedMessage) -> None:
        """The host has said this, which is not kept here."""
        if received.topic.writer is Party.HOST and received.stamp is not None:
            self._host_ns = max(self._host_ns, received.stamp.sim_ns)

    def add(self, messages: Iterable[ReceivedMessage]) -> None:
        """Take messages in; those of a key come in their order."""
        held, of_key = self._held, self._of_key
        for received in messages:
            key, stamp = received.key, received.stamp
            claimed_ns = stamp.sim_ns if stamp is not None else -1
            place = _PLACES.get(received.topic.key, _LAST)
            if place != _LAST:
                if claimed_ns > self._host_ns:
                    self._host_ns = claimed_ns
            elif claimed_ns > self._host_ns:
                claimed_ns = -1  # it claims to be ahead of the host
            log_ns = claimed_ns if claimed_ns >= 0 else self._host_ns
            previous_ns, number = of_key.get(key, _FIRST)
            if log_ns < previous_ns:
                log_ns = previous_ns
            of_key[key] = log_ns, number + 1
            held.append((log_ns, place, key, number, received))

    def release(self, before_ns: int | None = None) -> list[tuple[int, ReceivedMessage]]:
        """Give out what is older than `before_ns`, or everything: log time in ns, never running backward, and message.

        A message that is older than what was released already gets the log time of that.
        """
        held, released_ns = self._held, self._released_ns
        held.sort()
        count = len(held) if before_ns is None else bisect_left(held, before_ns, key=itemgetter(0))
        out = [
            (log_ns if log_ns > released_ns else released_ns, received) for log_ns, _, _, _, received in held[:count]
        ]
        if out:
            self._released_ns = out[-1][0]
        del held[:count]
        return out
