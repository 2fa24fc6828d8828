"""The two sides of a match."""

from enum import StrEnum
from typing import Literal


class Side(StrEnum):
    """A team's colour."""

    CYAN = "cyan"
    MAGENTA = "magenta"

    @property
    def opponent(self) -> "Side":
        """The other side."""
        return Side.MAGENTA if self is Side.CYAN else Side.CYAN

    def attack(self, cyan_attacks: int) -> Literal[1, -1]:
        """Sign of the x direction that this side attacks, where cyan attacks `cyan_attacks` (+1 or −1)."""
        return 1 if (self is Side.CYAN) == (cyan_attacks > 0) else -1
