"""Whether the host of a match is there: by its token, and by the link to it.

The token goes with the link, and comes back a moment after the link does.
"""

from schemas.bus.contract import LEASE_S, Bus, PresenceKind
from schemas.process.active_clock import ActiveClock

LINK_GRACE_S = LEASE_S + 0.5
"""Wall time that watchers give a broken link to come back."""
RECONNECT_S = 10.0
"""Wall time that agents and recorders give a host to come back: until then a match, or a recording, can go on."""
_LOOK_S = 0.02
"""Wall time between two looks for a host that is waited for."""


class HostWatch:
    """Follows the host's token from the moment it is made. Wall time in which it was suspended does not count."""

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._watch = bus.watch_alive()
        self._is_quiet = self._watch.is_empty
        self._hosts: set[str] = set()
        self._active = ActiveClock(bus.clock.now())
        self._reached_at = self._linked_at = 0.0
        self.seen = False
        """Whether a host was ever there."""

    def update(self) -> bool:
        """Take in who came and went; whether a host went since the last time, even if it is back by now."""
        if self._is_quiet():
            return False
        went = False
        while (presence := self._watch.receive()) is not None:
            if presence.kind is not PresenceKind.HOST:
                continue
            if presence.alive:
                self.seen = True
                self._hosts.add(presence.name)
            else:
                went = True
                self._hosts.discard(presence.name)
        return went

    def is_reachable(self) -> bool:
        """Whether token and link are there; a host that never had a token counts while the link is up."""
        now = self._now()
        reachable = self._bus.connected() and (bool(self._hosts) or not self.seen)
        if reachable:
            self._reached_at = now
        return reachable

    def unreachable_s(self) -> float:
        """Wall time since the host was last found reachable, s."""
        return self._now() - self._reached_at

    def has_left(self) -> bool:
        """For watchers: whether the host was there, and its token is gone or the link broken for too long."""
        self.update()
        now = self._now()
        if self._bus.connected():
            self._linked_at = now
        return self.seen and (not self._hosts or now - self._linked_at > LINK_GRACE_S)

    def wait(self, patience: float) -> bool:
        """Whether the host shows itself within `patience` s of wall time."""
        clock = self._bus.clock
        deadline = clock.now() + patience
        self.update()
        while not self.seen and clock.now() < deadline:
            clock.sleep_until(clock.now() + _LOOK_S)
            self.update()
        return self.seen

    def _now(self) -> float:
        return self._active.look(self._bus.clock.now())
