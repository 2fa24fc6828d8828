"""Which team a base station is: by what it says, or by the port it came to; never by its address. Pure.

It may declare itself: `{"type": "hello", "team": "cyan"}` with the colour or the team's name, or with the `token` of
its coach, and with the `address` that it wants to be called by. Software that knows no such word is known by the
`teamName` of its world states, or by a port that is one team's.
"""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from schemas.errors import did_you_mean
from schemas.side import Side

HELLO = "hello"
_MAX_WORD = 80


class Identity(NamedTuple):
    """Who has come, and by what it wants to be called."""

    side: Side
    address: str | None = None


class UnknownTeamError(ValueError):
    """It says who it is, and is not; the sentence tells why."""


def targets(names: Mapping[Side, str], addresses: Mapping[Side, str]) -> dict[Side, str]:
    """By what each team is called in commands: its own wish, else its name; of two alike, magenta's ends with `:1`."""
    called = {side: addresses.get(side) or names[side] for side in Side}
    if called[Side.CYAN] == called[Side.MAGENTA]:
        called[Side.MAGENTA] += ":1"
    return called


def identify(
    said: Mapping[str, Any], names: Mapping[Side, str], of_token: Callable[[str], Side | None]
) -> Identity | None:
    """Who says this; nothing where that does not tell.

    Raises:
        UnknownTeamError: a name that no team has, or a token that is nobody's.
    """
    if said.get("type") != HELLO:
        team = said.get("teamName")
        side = _by_name(team, names) if isinstance(team, str) else None
        return Identity(side) if side is not None else None
    address = said.get("address")
    called = address.strip()[:_MAX_WORD] if isinstance(address, str) and address.strip() else None
    token, team = said.get("token"), said.get("team")
    if isinstance(token, str) and token:
        side = of_token(token)
        if side is None:
            raise UnknownTeamError("the token is nobody's")
        return Identity(side, called)
    side = _by_name(team, names) if isinstance(team, str) else None
    if side is None:
        known = [side.value for side in Side] + list(names.values())
        raise UnknownTeamError(f'no team is called "{str(team)[:_MAX_WORD]}"; {did_you_mean(str(team), known)}')
    return Identity(side, called)


def _by_name(word: str, names: Mapping[Side, str]) -> Side | None:
    """By colour, or by a name that one team alone has."""
    plain = word.strip().lower()
    found = [side for side in Side if plain == side.value] or [
        side for side in Side if plain == names[side].strip().lower()
    ]
    return found[0] if len(found) == 1 else None
