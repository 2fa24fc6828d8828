"""All connections to the page's port, from their first byte: how many wait, and which one is closed to make room.

A connection waits until it holds a page, that is from its first byte to the end of the WebSocket's handshake, or until
its file has been sent. One client can open as many as it likes: those of the network with the most are closed first.
"""

from collections import Counter
from collections.abc import Callable, Iterator
from typing import Protocol

from coach_gateway.access.client_network import client_network
from coach_gateway.access.network_limits import NetworkLimits
from coach_gateway.access.origins import Origins
from coach_gateway.access.refusals import Refusals
from schemas.process.clock import Clock

MOST_WAITING = 400
"""Connections that wait at the same time; a browser opens six to load the page."""
NEW_PER_S, NEW_AT_ONCE = 100.0, 1000.0
"""New connections of one network per s of wall time, and at once: a hundred browsers load the page at the same time."""
MOST_HELD = 64
"""Refused connections that are held at the same time; further ones are closed at once."""
FLOOD_COSTS = 50.0
"""Connections that one of its network counts for that was closed because it sent too much."""
REQUESTS_PER_S, REQUESTS_AT_ONCE = 200.0, 6000.0
"""Files for one network per s of wall time, and at once; a page has about fifty."""


class Connection(Protocol):
    """What has to be known of a connection."""

    network: str | None
    """The client network; None for this machine."""

    @property
    def holds_page(self) -> bool:
        """Whether a page is open on it."""

    @property
    def is_serving(self) -> bool:
        """Whether a request is in progress."""

    def cut(self) -> None:
        """Close it at once."""


class NewConnection(Connection, Protocol):
    """One that may be refused before anything is read."""

    def hold(self) -> None:
        """Read nothing, and close it a while later."""


class Connections:
    """The open connections of a server."""

    def __init__(self, refusals: Refusals, clock: Clock) -> None:
        self.refusals, self.clock = refusals, clock
        self._open: dict[Connection, None] = {}
        self._held: set[Connection] = set()
        self._new = NetworkLimits(NEW_PER_S, NEW_AT_ONCE)
        self._requests = NetworkLimits(REQUESTS_PER_S, REQUESTS_AT_ONCE)

    def __len__(self) -> int:
        return len(self._open)

    def admit(self, connection: NewConnection) -> bool:
        """Take in a new connection, and close another one if too many wait; returns False beyond the rate limit.

        Some beyond it are held for a while: a client that waits for their end comes back later.
        """
        if not self._new.allow(connection.network, self.clock.now()):
            if len(self._held) >= MOST_HELD:
                self.refuse(connection, "connections")
                return False
            self.refusals.note("connections", connection.network, self.clock.now())
            self._held.add(connection)
            connection.hold()
            return False
        self.enter(connection)
        waiting = list(self._waiting())
        if len(waiting) > MOST_WAITING:
            crowd = Counter(one.network for one in waiting).most_common(1)[0][0]
            victim = min((one for one in waiting if one.network == crowd), key=lambda one: one.is_serving)
            self.refuse(victim, "crowded")
        return True

    def enter(self, connection: Connection) -> None:
        """Take in a connection that was admitted before, under another protocol."""
        self._open[connection] = None

    def remove(self, connection: Connection) -> None:
        """Forget a closed connection."""
        self._open.pop(connection, None)
        self._held.discard(connection)

    def refuse(self, connection: Connection, kind: str) -> None:
        """Count a refusal, and close the connection."""
        self.refusals.note(kind, connection.network, self.clock.now())
        self.remove(connection)
        connection.cut()

    def note_flood(self, connection: Connection, kind: str, reason: str = "") -> None:
        """Count a client that is being closed because it sends too much, or breaks the protocol."""
        self.refusals.note(kind, connection.network, self.clock.now(), reason)
        self.penalize(connection)

    def penalize(self, connection: Connection) -> None:
        """Let a network that has flooded open fewer connections: else it would be back at once."""
        self._new.count(connection.network, self.clock.now(), FLOOD_COSTS)

    def is_within_limit(self, connection: Connection) -> bool:
        """Whether a network may have one more file."""
        return self._requests.allow(connection.network, self.clock.now())

    def _waiting(self) -> Iterator[Connection]:
        return (one for one in self._open if not one.holds_page)


def host_check(origins: Origins, connections: Connections) -> Callable[[str | None, str | None], bool]:
    """Whether a Host header names this server; a client's request for another host is counted."""

    def is_known(host: str | None, client: str | None) -> bool:
        known = origins.knows(host)
        if not known:
            connections.refusals.note("host", client_network(client), connections.clock.now(), f"host {host}")
        return known

    return is_known
