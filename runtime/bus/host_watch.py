"""Presence of a match's host, by its liveliness token and the link to it.

The token disappears with the link, and appears again a moment after the link is restored.
"""

from runtime.bus.contract import Bus, PresenceKind
from runtime.process.active_clock import ActiveClock
from runtime.process.timing import CUT_OFF_S, LINK_GRACE_S, POLL_S, PROBE_EVERY_S


class HostWatch:
    """Follows the host's token from construction on. Wall time in which the process was suspended does not count."""

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._watch = bus.watch_alive()
        self._is_quiet = self._watch.is_empty
        self._hosts: set[str] = set()
        self._active = ActiveClock(bus.clock.now())
        self._reached_at = self._linked_at = 0.0
        self._cut_off_at = 0.0
        """When the network was last found to be cut."""
        self._probed_at = 0.0
        self.seen = False
        """Whether a host has been present."""

    def update(self) -> bool:
        """Process changes of presence; returns whether a host has left since the last call, even if it is back."""
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
        """Whether the token exists and the link is up; before the first token, the link alone counts."""
        now = self._now()
        reachable = self._bus.connected() and (bool(self._hosts) or not self.seen)
        if reachable:
            self._reached_at = now
        return reachable

    def is_given_up(self, patience: float) -> bool:
        """For agents and recorders: whether the host has been unreachable for `patience` s of wall time.

        The wait begins again while the network is cut, for up to `CUT_OFF_S`.
        """
        now = self._now()
        if now - self._probed_at >= PROBE_EVERY_S and now - self._reached_at < CUT_OFF_S:
            self._probed_at = now
            if self._bus.is_cut_off():
                self._cut_off_at = now
        return now - max(self._reached_at, self._cut_off_at) >= patience

    def has_left(self) -> bool:
        """For watchers: whether the host was present and its token is gone, or the link has been down for too long."""
        self.update()
        now = self._now()
        if self._bus.connected():
            self._linked_at = now
        return self.seen and (not self._hosts or now - self._linked_at > LINK_GRACE_S)

    def wait(self, patience: float) -> bool:
        """Wait up to `patience` s of wall time for the host; returns whether it is present."""
        clock = self._bus.clock
        deadline = clock.now() + patience
        self.update()
        while not self.seen and clock.now() < deadline:
            clock.sleep_until(clock.now() + POLL_S)
            self.update()
        return self.seen

    def _now(self) -> float:
        return self._active.look(self._bus.clock.now())
