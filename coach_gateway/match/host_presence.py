"""Whether the host of a match is there: its liveliness token is seen, and the link to it is up."""

from schemas.bus.contract import Bus

GRACE = 2.5
"""Wall time in s that a broken link may take to come back: a little more than the bus's lease."""


class HostPresence:
    """Follows the host's liveliness token."""

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._watch = bus.watch_alive()
        self._linked_at = bus.clock.now()
        self.seen = False
        """The host has been there at least once."""
        self.there = False
        """The host's token is there."""

    def gone(self) -> bool:
        """Whether the host was there and has left."""
        while (presence := self._watch.receive()) is not None:
            if presence.kind == "host":
                self.there = presence.alive
                self.seen = self.seen or presence.alive
        now = self._bus.clock.now()
        if self._bus.connected():
            self._linked_at = now
        return self.seen and (not self.there or now - self._linked_at > GRACE)

    def wait(self, patience: float) -> bool:
        """Wait up to `patience` s of wall time for the host; returns whether it has appeared."""
        clock = self._bus.clock
        deadline = clock.now() + patience
        while not self.seen and clock.now() < deadline:
            self.gone()
            clock.sleep_until(clock.now() + 0.02)
        return self.seen
