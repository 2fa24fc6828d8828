"""Checks of tokens: a network that sends unknown tokens waits before its next check, and is never locked out.

The right token is accepted however many wrong ones came from the same network: people behind one address, or behind a
proxy, share a network with those who guess. A guess then takes a second of one connection, and connections are limited.
"""

from coach_gateway.access.network_limits import NetworkLimits
from coach_gateway.access.roles import Role
from coach_gateway.access.tokens import Tokens

PAUSE_S = 1.0
"""s of wall time before a check for a network that has sent too many unknown tokens."""
UNKNOWN_PER_S, UNKNOWN_AT_ONCE = 0.5, 30.0
"""Unknown tokens of a network per s of wall time, and at once, before it has to wait."""


class GuessLimit:
    """Which networks guess at tokens."""

    def __init__(self) -> None:
        self._unknown = NetworkLimits(UNKNOWN_PER_S, UNKNOWN_AT_ONCE)

    def note_unknown(self, network: str | None, now: float) -> None:
        """Count an unknown token of a network."""
        self._unknown.allow(network, now)

    def pause(self, network: str | None, now: float) -> float:
        """s of wall time to wait before a token of this network is checked."""
        return PAUSE_S if self._unknown.is_spent(network, now) else 0.0


class TokenChecks(GuessLimit):
    """The tokens of one gateway, and which networks guess at them."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens

    def role_of(self, token: str) -> Role | None:
        """The role of a token: spectator for an empty token, None for an unknown one."""
        return self._tokens.role_of(token)
