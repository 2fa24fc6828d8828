"""The box's single characters of 2015 to 2019, both ways. Pure."""

from schemas.league.signals import BY_CHARACTER, Signal
from schemas.side import Side


def read(character: str) -> tuple[Signal, Side | None]:
    """The signal of a character, and its side; of sided signals, capital letters are cyan's.

    Raises:
        KeyError: the character has no signal.
    """
    return BY_CHARACTER[character]


def write(signal: Signal, side: Side | None = None) -> str | None:
    """The character of a signal; None for signals that only JSON has."""
    if not signal.character:
        return None
    return signal.character.lower() if signal.sided and side is Side.MAGENTA else signal.character
