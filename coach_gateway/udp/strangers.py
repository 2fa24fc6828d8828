"""Datagrams without a session: how many are read, and how long a refusal may be. Pure.

The source of such a datagram may be forged. So each source, each network and all together have a limit, and a refusal
is no longer than its datagram: the gateway amplifies nothing for a sender that forges an address.
"""

import json
from collections import OrderedDict
from typing import Any

from coach_gateway.access.client_network import client_network
from coach_gateway.access.network_limits import NetworkLimits
from coach_gateway.access.rate_limit import TokenBucket
from coach_gateway.udp.protocol import Ack

SOURCE_PER_S, SOURCE_AT_ONCE = 5.0, 10.0
"""Datagrams of one address and port that are read per s of wall time, and at once."""
NETWORK_PER_S, NETWORK_AT_ONCE = 20.0, 50.0
"""Those of one network: a network that floods keeps none of the others out."""
ALL_PER_S, ALL_AT_ONCE = 500.0, 1000.0
"""Those of all networks."""
_MOST_KNOWN = 256
"""Addresses of ended sessions that are remembered."""

Address = tuple[Any, ...]


class Strangers:
    """The senders that have no session."""

    def __init__(self, now: float) -> None:
        self._sources = NetworkLimits(SOURCE_PER_S, SOURCE_AT_ONCE)
        self._networks = NetworkLimits(NETWORK_PER_S, NETWORK_AT_ONCE)
        self._all = TokenBucket(ALL_PER_S, ALL_AT_ONCE, now)
        self._known: OrderedDict[Address, None] = OrderedDict()

    def allow(self, address: Address, now: float) -> bool:
        """Whether a datagram of this source is read."""
        return (
            self._sources.allow(address, now)
            and self._networks.allow(client_network(address[0]), now)
            and self._all.allow(now)
        )

    def remember(self, address: Address) -> None:
        """Note an address that has had a session: it is no forged one."""
        self._known.pop(address, None)
        self._known[address] = None
        if len(self._known) > _MOST_KNOWN:
            self._known.popitem(last=False)

    def is_known(self, address: Address) -> bool:
        """Whether an address has had a session."""
        return address in self._known


def short_refusal(ack: Ack, room: int) -> bytes | None:
    """A refusal within this number of bytes, its reason cut; None where no refusal is that short."""
    content = {"kind": ack.kind, "sequence": ack.sequence, "of": ack.of, "accepted": False, "reason": ack.reason}
    if len(_encoded(content)) > room:
        del content["of"]
    while (excess := len(_encoded(content)) - room) > 0:
        reason = str(content["reason"])
        if not reason:
            return None
        content["reason"] = reason[: -min(len(reason), (excess + 3) // 4)]
    return _encoded(content)


def _encoded(content: dict[str, Any]) -> bytes:
    return json.dumps(content, ensure_ascii=False, separators=(",", ":")).encode(errors="replace")
