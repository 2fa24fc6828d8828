"""One order for the messages of many keys: by simulated time, each key in its own order, and the same in every run.

Robots answer in an order that no two runs share, a message may come late, and sights come on a way of their own. So all
are held for a moment and released tick by tick.
"""

from bisect import bisect_left
from collections.abc import Iterable
from operator import itemgetter

from schemas.bus.contract import Received
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

Timed = tuple[int, int, str, int, Received]
"""A message behind its place: simulated time in ns, place of its row, key, and number on the key; sorts by these."""


_FIRST = (0, 0)


class SimOrder:
    """Holds messages, and releases them in order."""

    def __init__(self) -> None:
        self._held: list[Timed] = []
        self._of_key: dict[str, tuple[int, int]] = {}
        self._host_ns = 0
        self._settled_ns: int | None = None
        self._released_ns = 0

    def __len__(self) -> int:
        return len(self._held)

    @property
    def host_ns(self) -> int:
        """The newest simulated time that the host has sent, in ns."""
        return self._host_ns

    @property
    def settled_ns(self) -> int:
        """Up to where the host's minutes have come, ns."""
        return self._host_ns if self._settled_ns is None else self._settled_ns

    def settle(self, minutes: Received) -> None:
        """All that these minutes hold was taken in."""
        if minutes.stamp is not None:
            self._settled_ns = max(self._settled_ns or 0, minutes.stamp.sim_ns)
            self._host_ns = max(self._host_ns, minutes.stamp.sim_ns)

    def reach(self, received: Received) -> None:
        """The host has said this, which is not kept here."""
        if received.topic.writer is Party.HOST and received.stamp is not None:
            self._host_ns = max(self._host_ns, received.stamp.sim_ns)

    def add(self, messages: Iterable[Received]) -> None:
        """Take messages in; those of a key come in their order."""
        held, of_key = self._held, self._of_key
        for received in messages:
            key, stamp = received.key, received.stamp
            said = stamp.sim_ns if stamp is not None else -1
            place = _PLACES.get(received.topic.key, _LAST)
            if place != _LAST:
                if said > self._host_ns:
                    self._host_ns = said
            elif said > self._host_ns:
                said = -1  # it claims to be ahead of the host
            moment = said if said >= 0 else self._host_ns
            last, number = of_key.get(key, _FIRST)
            if moment < last:
                moment = last
            of_key[key] = moment, number + 1
            held.append((moment, place, key, number, received))

    def release(self, before_ns: int | None = None) -> list[tuple[int, Received]]:
        """Give out what is older than `before_ns`, or everything: log time in ns, never running backward, and message.

        A message that is older than what was released already gets the log time of that.
        """
        held, least = self._held, self._released_ns
        held.sort()
        count = len(held) if before_ns is None else bisect_left(held, before_ns, key=itemgetter(0))
        out = [(moment if moment > least else least, received) for moment, _, _, _, received in held[:count]]
        if out:
            self._released_ns = out[-1][0]
        del held[:count]
        return out
