"""The base stations that are connected to our box: which one gives way to another."""

import asyncio
from dataclasses import dataclass, field
from enum import IntEnum

from coach_gateway.soccer.refbox.framing import Framer
from coach_gateway.timing import SILENCE_S
from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.side import Side

MOST = 16
"""Base stations at the same time. A further one replaces one that has not identified itself, or is turned away."""


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
    host: str
    port: int
    begun_at: float
    side: Side | None = None
    proof: Proof = Proof.NAME
    protocol: BoxProtocol = BoxProtocol.JSON
    """Protocol of the commands that are sent to it; its own messages are JSON in any case."""
    framer: Framer = field(default_factory=lambda: Framer(BoxProtocol.JSON))

    def __post_init__(self) -> None:
        self.heard_at = self.begun_at
        """Wall time in s of its last message."""

    @property
    def name(self) -> str:
        """Its address, for people."""
        return f"{self.host}:{self.port}"


def why_kept(other: Peer, proof: Proof, host: str, now: float) -> str:
    """Why a base station is not replaced by one with this proof from this address; empty when it is."""
    if other.proof > proof:
        return "its base station has proven more; send the token of its coach in the hello"
    if proof is not Proof.TOKEN and other.host != host and now - other.heard_at < SILENCE_S:
        return "its base station at another address is in use; send the token of its coach in the hello"
    return ""
