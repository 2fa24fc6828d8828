"""Which link floods the host, and which clients it refuses after that. Knows neither bus nor clock.

An honest link carries what the host reads, and little else. A flood carries far more than the host reads: the router
drops most of it, and a message that the host ignores is not read. The system's count of bytes shows on which link it
comes, which no message does.
"""

import threading
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple, TypeVar

from schemas.bus.links import Link
from schemas.messages.health import ConnectionHealth

MOST_EXTRA_RATE = 500_000.0
"""Most bytes a second of a link beyond those that the host has read."""
READ_FACTOR = 2.0
"""Bytes of a link for each byte of payload that the host has read: attachments, headers and keys are bytes too."""
PERIODS = 3
"""Periods in a row above that limit after which a link is closed."""
_FAMILIAR_S = 5.0
"""Wall time after which an orderly client is known: its new links are not refused for the sake of others."""
FIRST_REFUSAL_S = 4.0
"""Wall time for which a client is refused whose link was closed. It doubles with each time that it goes on."""
_LONGEST_CLIENT_S = 64.0
_LONGEST_ADDRESS_S = 8.0
"""Longest wall time for which unknown clients of an address are refused; an agent tries to connect for longer."""
_REMEMBERED_S = 120.0
"""Wall time after its last flood at which a client, or an address, begins anew."""
_MAX_REMEMBERED = 1000
"""Clients and addresses that are remembered."""
_MAX_ADDRESSES = 20
"""Addresses that are counted separately: reports on health must not grow with a network."""
_OTHERS = "others"
T = TypeVar("T")


class Flood(NamedTuple):
    """A link that is to be closed."""

    link: Link
    rate: float
    """Bytes a second that it carried in the last period."""


@dataclass(slots=True)
class _Counts:
    closed: int = 0
    refused: int = 0


@dataclass(slots=True)
class _LinkState:
    received: int
    since: float
    """Wall time since which its client is orderly."""
    periods: int = 0
    """Periods in a row above the limit."""


@dataclass(slots=True)
class _Offender:
    """A client, or an address, whose link was closed."""

    times: int
    """Floods, one after the other."""
    last: float
    """Wall time of the last one."""
    refused_until: float


class LinkLimits:
    """All links of a match."""

    def __init__(self, *, forgiving: bool = False) -> None:
        self._forgiving = forgiving
        self._lock = threading.Lock()
        self._links: dict[Link, _LinkState] = {}
        self._clients: OrderedDict[str, _Offender] = OrderedDict()
        self._addresses: OrderedDict[str, _Offender] = OrderedDict()
        self._familiar: OrderedDict[str, None] = OrderedDict()
        self._counts: dict[str, _Counts] = {}
        self._period_began: float | None = None

    def end_period(self, traffic: Mapping[Link, int], read: int, now: float) -> list[Flood]:
        """End a period; returns the links that are to be closed.

        Args:
            traffic: link → bytes received by it since it was opened.
            read: bytes of the messages that the host has read in this period.
            now: wall time in s.
        """
        began, self._period_began = self._period_began, now
        if self._forgiving:
            return []
        seconds = now - began if began is not None else 0.0
        most = MOST_EXTRA_RATE * seconds + READ_FACTOR * read
        with self._lock:
            before, self._links = self._links, {}
            floods = []
            for link, received in traffic.items():
                state = self._links[link] = before.get(link) or _LinkState(0, now)
                increase, state.received = received - state.received, received
                state.periods = state.periods + 1 if seconds and increase > most else 0
                if state.periods >= self._patience(link, now):
                    floods.append(Flood(link, increase / seconds))
                    self._offend(link, now)
                    del self._links[link]
                elif state.periods:
                    state.since = now
                elif now - state.since >= _FAMILIAR_S:
                    _remember(self._familiar, link.client, None)
            return floods

    def is_refused(self, link: Link, now: float) -> bool:
        """Whether a new link is to be closed: its client has flooded the host, or is unknown at such an address."""
        with self._lock:
            client, address = self._clients.get(link.client), self._addresses.get(link.address)
            is_offender = client is not None and now < client.refused_until
            is_suspect = address is not None and now < address.refused_until and link.client not in self._familiar
            if is_offender or is_suspect:
                self._count(link).refused += 1
            return is_offender or is_suspect

    def health(self) -> dict[str, ConnectionHealth]:
        """The counts as they are published."""
        with self._lock:
            return {
                address: ConnectionHealth(closed=counts.closed, refused=counts.refused)
                for address, counts in self._counts.items()
            }

    def _patience(self, link: Link, now: float) -> int:
        """Periods above the limit that are allowed; one where a flood has just come from."""
        address = self._addresses.get(link.address)
        is_suspect = address is not None and now - address.last < _REMEMBERED_S and link.client not in self._familiar
        return 1 if is_suspect else PERIODS

    def _offend(self, link: Link, now: float) -> None:
        self._count(link).closed += 1
        self._familiar.pop(link.client, None)
        client, address = _again(self._clients, link.client, now), _again(self._addresses, link.address, now)
        client.refused_until = now + min(FIRST_REFUSAL_S * 2.0 ** (client.times - 1), _LONGEST_CLIENT_S)
        if address.times > 1:  # one client alone is no reason to refuse its neighbours
            address.refused_until = now + min(2.0 ** (address.times - 1), _LONGEST_ADDRESS_S)

    def _count(self, link: Link) -> _Counts:
        name = link.address if link.address in self._counts or len(self._counts) < _MAX_ADDRESSES else _OTHERS
        return self._counts.setdefault(name, _Counts())


def _again(offenders: OrderedDict[str, _Offender], name: str, now: float) -> _Offender:
    """The entry of an offender, with this flood counted."""
    known = offenders.get(name)
    times = known.times + 1 if known is not None and now - known.last < _REMEMBERED_S else 1
    return _remember(offenders, name, _Offender(min(times, 10), now, known.refused_until if known is not None else now))


def _remember(known: OrderedDict[str, T], name: str, value: T) -> T:
    """Set a value, and forget the oldest beyond those that are remembered."""
    known[name] = value
    known.move_to_end(name)
    if len(known) > _MAX_REMEMBERED:
        known.popitem(last=False)
    return value
