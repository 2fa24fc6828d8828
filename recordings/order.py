"""One order for the messages of many keys: by simulated time, each key in its own order, and the same in every run.

Messages come through as many mailboxes as there are topics. Written as they are met, twenty ticks of one topic would
stand before the first tick of the next; so they are held for a moment and released tick by tick.
"""

from bisect import bisect_left
from operator import itemgetter

from schemas.bus.contract import Received
from schemas.topic import Party
from schemas.topics import APPLIED, INTAKE, WORLD

_EACH_TICK = frozenset({WORLD.key, APPLIED.key, INTAKE.key})
"""What the host says once in every tick: how far each of them has come tells what can be missing still."""


Timed = tuple[int, int, str, int, Received]
"""A message behind its place: simulated time in ns, topic of the table, key, and number on the key; sorts by these."""


_FIRST = (0, 0)


class SimOrder:
    """Holds messages, and releases them in order."""

    def __init__(self) -> None:
        self._held: list[Timed] = []
        self._of_key: dict[str, tuple[int, int]] = {}
        self._host_ns = 0
        self._each_tick: dict[str, int] = {}
        self._released_ns = 0

    def __len__(self) -> int:
        return len(self._held)

    @property
    def host_ns(self) -> int:
        """The newest simulated time that the host has sent, in ns."""
        return self._host_ns

    @property
    def settled_ns(self) -> int:
        """Up to where all that comes in every tick has come, ns; one of them may be recovered late."""
        return min(self._each_tick.values(), default=self._host_ns)

    def reach(self, received: Received) -> None:
        """The host has said this, which is not kept here."""
        if received.topic.writer is Party.HOST and received.stamp is not None:
            self._reach(received.key, received.stamp.sim_ns)

    def _reach(self, key: str, sim_ns: int) -> None:
        self._host_ns = max(self._host_ns, sim_ns)
        if key in _EACH_TICK:
            self._each_tick[key] = max(self._each_tick.get(key, 0), sim_ns)

    def add(self, row: int, received: Received) -> None:
        """Take a message in; the order of calls is the order of its key."""
        key = received.key
        last, number = self._of_key.get(key, _FIRST)
        moment = self._moment(received)
        if moment < last:
            moment = last
        self._of_key[key] = moment, number + 1
        self._held.append((moment, row, key, number, received))

    def release(self, before_ns: int | None = None) -> list[tuple[int, Received]]:
        """Give out what is older than `before_ns`, or everything: log time in ns, never running backward, and message.

        A message that is older than what was released already gets the log time of that.
        """
        self._held.sort()
        count = len(self._held)
        if before_ns is not None:
            count = bisect_left(self._held, before_ns, key=itemgetter(0))
        out, released_ns = [], self._released_ns
        for sim_ns, _, _, _, received in self._held[:count]:
            released_ns = max(released_ns, sim_ns)
            out.append((released_ns, received))
        self._released_ns = released_ns
        del self._held[:count]
        return out

    def _moment(self, received: Received) -> int:
        """The sender's simulated time; the host's newest when the sender knows none, or claims to be ahead of it."""
        said = received.stamp.sim_ns if received.stamp is not None else -1
        if received.topic.writer is Party.HOST:
            self._reach(received.key, said)
            return said if said >= 0 else self._host_ns
        return min(said, self._host_ns) if said >= 0 else self._host_ns
