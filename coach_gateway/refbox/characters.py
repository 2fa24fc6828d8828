"""The single characters that RefBox sent from 2015 to 2019, both ways. Pure."""

from schemas.league.signals import BY_CHARACTER, Signal
from schemas.side import Side


def read(character: str) -> tuple[Signal, Side | None]:
    """The signal of a character, and for whom; capital letters are cyan's where a side is meant.

    Raises:
        KeyError: it is none.
    """
    return BY_CHARACTER[character]


def write(signal: Signal, side: Side | None = None) -> str | None:
    """The character of a signal; nothing for those that came with JSON only."""
    if not signal.character:
        return None
    return signal.character.lower() if signal.sided and side is Side.MAGENTA else signal.character
