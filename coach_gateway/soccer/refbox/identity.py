"""Which team a base station belongs to: by its messages, or by the port it connects to; never by its address. Pure.

A base station may identify itself: `{"type": "hello", "team": "cyan"}` with the colour or the team's name, or with the
`token` of its coach, with the `address` that it wants to be addressed by, and with the `protocol`, `json` or
`characters`, in which it wants its commands. Software without this message is
identified by the `teamName` of its world states, or by a port that one team alone uses.
"""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from schemas.errors import did_you_mean
from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.side import Side

HELLO = "hello"
SENT = (BoxProtocol.JSON.value, BoxProtocol.CHARACTERS.value)
"""Protocols of the commands that our box sends."""
_MAX_WORD = 80


class Identity(NamedTuple):
    """The side of a base station, and the address that it wants."""

    side: Side
    address: str | None = None
    protocol: BoxProtocol | None = None
    """The protocol that it wants; None for its port's."""


class UnknownTeamError(ValueError):
    """A base station has introduced itself wrongly; the message has the reason."""


def targets(names: Mapping[Side, str], addresses: Mapping[Side, str]) -> dict[Side, str]:
    """The address of each team in commands: the wanted one, else its name; if both are equal, magenta's gets `:1`."""
    called = {side: addresses.get(side) or names[side] for side in Side}
    if called[Side.CYAN] == called[Side.MAGENTA]:
        called[Side.MAGENTA] += ":1"
    return called


def identify(
    message: Mapping[str, Any], names: Mapping[Side, str], of_token: Callable[[str], Side | None]
) -> Identity | None:
    """The identity in a message; None where it has none.

    Raises:
        UnknownTeamError: a name that no team has, or an unknown token.
    """
    if message.get("type") != HELLO:
        team = message.get("teamName")
        side = _by_name(team, names) if isinstance(team, str) else None
        return Identity(side) if side is not None else None
    address = message.get("address")
    called = address.strip()[:_MAX_WORD] if isinstance(address, str) and address.strip() else None
    protocol = _protocol(message.get("protocol"))
    token, team = message.get("token"), message.get("team")
    if token:
        side = of_token(token) if isinstance(token, str) else None
        if side is None:
            raise UnknownTeamError("unknown token")
        return Identity(side, called, protocol)
    side = _by_name(team, names) if isinstance(team, str) else None
    if side is None:
        known = [side.value for side in Side] + list(names.values())
        raise UnknownTeamError(f'no team is called "{str(team)[:_MAX_WORD]}"; {did_you_mean(team, known)}')
    return Identity(side, called, protocol)


def _protocol(word: object) -> BoxProtocol | None:
    """The protocol in a hello.

    Raises:
        UnknownTeamError: an unknown protocol.
    """
    if word is None:
        return None
    if word not in SENT:
        raise UnknownTeamError(f'protocol is "{str(word)[:_MAX_WORD]}"; it is {" or ".join(SENT)}')
    return BoxProtocol(str(word))


def _by_name(word: str, names: Mapping[Side, str]) -> Side | None:
    """The side of a colour, or of a name that one team alone has."""
    plain = word.strip().lower()
    found = [side for side in Side if plain == side.value] or [
        side for side in Side if plain == names[side].strip().lower()
    ]
    return found[0] if len(found) == 1 else None
