"""The base stations that are connected to our box: which one gives way to another."""

import asyncio
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import IntEnum

from coach_gateway.access.rate_limit import TokenBucket
from coach_gateway.refbox.framing import BoxProtocol, Framer
from schemas.side import Side

MOST = 16
"""Base stations at the same time. A further one replaces one that has not identified itself, or is turned away."""
IN_USE_S = 5.0
"""s of wall time since its last message in which a base station is in use."""
_BYTES_PER_S, _BYTES_AT_ONCE = 500_000.0, 1_000_000.0
"""Bytes of one base station that are read per s of wall time, and at once: fifty large world states."""
_MESSAGE_COST = 500
"""Bytes that a message counts for beside its own."""
_HELLOS_PER_S, _HELLOS_AT_ONCE = 0.5, 10.0
"""Hellos of one base station per s of wall time, and at once."""


class Proof(IntEnum):
    """How a base station has shown which team it belongs to; a weaker proof replaces no stronger one."""

    NAME = 1
    """By a name that everybody knows."""
    PORT = 2
    """By a port that one team alone uses."""
    TOKEN = 3
    """By the token of the team's coach."""


@dataclass(eq=False)
class Peer:
    """One base station."""

    writer: asyncio.StreamWriter
    name: str
    network: str | None
    """Its client network; None for this machine."""
    begun_at: float
    side: Side | None = None
    proof: Proof = Proof.NAME
    protocol: BoxProtocol = BoxProtocol.JSON
    """Protocol of the commands that are sent to it; its own messages are JSON in any case."""
    framer: Framer = field(default_factory=lambda: Framer(BoxProtocol.JSON))

    def __post_init__(self) -> None:
        self.heard_at = self.begun_at
        """Wall time in s of its last message."""
        self._bytes = TokenBucket(_BYTES_PER_S, _BYTES_AT_ONCE, self.begun_at)
        self.hellos = TokenBucket(_HELLOS_PER_S, _HELLOS_AT_ONCE, self.begun_at)
        """How often it may identify itself."""

    def delay(self, now: float, size: int, messages: int) -> float:
        """s of wall time to wait before more of it is read, after this many bytes and messages."""
        return self._bytes.delay(now, size + _MESSAGE_COST * messages)


class Peers:
    """All base stations."""

    def __init__(self) -> None:
        self._open: list[Peer] = []

    def __iter__(self) -> Iterator[Peer]:
        return iter(tuple(self._open))

    def __len__(self) -> int:
        return len(self._open)

    def add(self, peer: Peer) -> None:
        """Take in a base station."""
        self._open.append(peer)

    def remove(self, peer: Peer) -> None:
        """Forget a base station that is gone."""
        if peer in self._open:
            self._open.remove(peer)

    def to_make_room(self, network: str | None) -> Peer | None:
        """The base station that gives way to a further one of this network; None where none has to, or none does.

        It is one without an identity, of the network that has most of these.
        """
        unidentified = [peer for peer in self._open if peer.side is None]
        if not unidentified:
            return None
        crowd = Counter(peer.network for peer in unidentified)
        crowd[network] += 1
        most = max(crowd[peer.network] for peer in unidentified)
        return next(peer for peer in unidentified if crowd[peer.network] == most)

    def of(self, side: Side, but: Peer) -> list[Peer]:
        """The other base stations of a side."""
        return [other for other in self._open if other is not but and other.side is side]

    def why_kept(self, other: Peer, proof: Proof, network: str | None, now: float) -> str:
        """Why a base station is not replaced by one with this proof from this network; empty when it is."""
        if other.proof > proof:
            return "its base station has proven more; send the token of its coach in the hello"
        if proof is not Proof.TOKEN and other.network != network and now - other.heard_at < IN_USE_S:
            return "its base station at another address is in use; send the token of its coach in the hello"
        return ""
