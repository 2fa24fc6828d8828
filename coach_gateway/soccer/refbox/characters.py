"""The box's single characters of 2015 to 2019, both ways. Pure."""

from schemas.messages.soccer.league.signals import BY_CHARACTER, Signal
from schemas.side import Side


def read(character: str) -> tuple[Signal, Side | None]:
    """The signal of a character, and its side; of sided signals, capital letters are cyan's.

    Raises:
        KeyError: the character has no signal.
    """
    return BY_CHARACTER[character]


def write(signal: Signal, side: Side | None = None) -> bytes:
    """The character of a signal on the wire; empty for signals that only JSON has."""
    lower = signal.sided and side is Side.MAGENTA
    return (signal.character.lower() if lower else signal.character).encode("ascii")
