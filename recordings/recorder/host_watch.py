"""Tells whether the host of a match is still there: by its token, and by the link to it."""

from recordings.recorder.active_clock import ActiveClock
from schemas.bus.contract import Bus

GRACE_S = 10.0
"""Wall time that a broken link has to come back, as agents give it. Until then all that was missed can be fetched."""


class HostWatch:
    """Follows the host's token from the moment it is made."""

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._watch = bus.watch_alive()
        self._hosts: set[str] = set()
        self._clock = ActiveClock(bus.clock.now())
        self._missed_at: float | None = None
        self.seen = False
        """Whether a host was ever there."""

    def gone(self, finished: bool) -> bool:
        """Whether the host was there and will not come back; after a finished match its absence is its farewell.

        The token of a host goes with the link to it, and comes back a moment after the link does.
        """
        self._receive()
        self._clock.update(self._bus.clock.now())
        if self._bus.connected() and (self._hosts or not self.seen):
            self._missed_at = None
            return False
        if self._missed_at is None:
            self._missed_at = self._clock.elapsed
        return finished or self._clock.elapsed - self._missed_at >= GRACE_S

    def _receive(self) -> None:
        while (presence := self._watch.receive()) is not None:
            if presence.kind != "host":
                continue
            self.seen = True
            if presence.alive:
                self._hosts.add(presence.name)
            else:
                self._hosts.discard(presence.name)
