"""One order for the messages of many keys: by simulated time, each key in its own order, and the same in every run.

Messages come through as many mailboxes as there are topics. Written as they are met, twenty ticks of one topic would
stand before the first tick of the next; so they are held for a moment and released tick by tick.
"""

from bisect import bisect_left
from collections.abc import Iterable
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

    def add(self, row: int, messages: Iterable[Received]) -> None:
        """Take messages in; those of a key come in their order."""
        held, of_key = self._held, self._of_key
        for received in messages:
            key, stamp = received.key, received.stamp
            said = stamp.sim_ns if stamp is not None else -1
            if received.topic.writer is Party.HOST:
                self._reach(key, said)
            elif said > self._host_ns:
                said = -1  # it claims to be ahead of the host
            moment = said if said >= 0 else self._host_ns
            last, number = of_key.get(key, _FIRST)
            if moment < last:
                moment = last
            of_key[key] = moment, number + 1
            held.append((moment, row, key, number, received))

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

    def _reach(self, key: str, sim_ns: int) -> None:
        if sim_ns > self._host_ns:
            self._host_ns = sim_ns
        if key in _EACH_TICK:
            self._each_tick[key] = max(self._each_tick.get(key, 0), sim_ns)
