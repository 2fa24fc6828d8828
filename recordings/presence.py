"""Tells whether the host of a match is still there: by its token, and by the link to it."""

from schemas.bus.contract import Bus

GRACE_S = 2.0
"""Wall time that a broken link has to come back."""


class HostWatch:
    """Follows the host's token from the moment it is made."""

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._watch = bus.watch_alive()
        self._hosts: set[str] = set()
        self._broken_at: float | None = None
        self.seen = False
        """Whether a host was ever there."""

    def gone(self, finished: bool) -> bool:
        """Whether the host was there and will not come back; after a finished match a broken link is its farewell."""
        self._follow()
        if self._bus.connected():
            self._broken_at = None
            return self.seen and not self._hosts
        now = self._bus.clock.now()
        if self._broken_at is None:
            self._broken_at = now
        return finished or now - self._broken_at >= GRACE_S

    def _follow(self) -> None:
        while (presence := self._watch.receive()) is not None:
            if presence.kind != "host":
                continue
            self.seen = True
            if presence.alive:
                self._hosts.add(presence.name)
            else:
                self._hosts.discard(presence.name)
