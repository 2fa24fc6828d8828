"""The roles that a page or a program has in a match. Each token stands for one."""

from enum import StrEnum

from schemas.side import Side


class TokenRole(StrEnum):
    """What a token stands for."""

    SPECTATOR = "spectator"
    """Without a token; watches."""
    CYAN = "cyan"
    """The coach of cyan."""
    MAGENTA = "magenta"
    """The coach of magenta."""
    REFEREE = "referee"
    """The referee, who runs the match and may do everything."""


COACHES = {TokenRole.CYAN: Side.CYAN, TokenRole.MAGENTA: Side.MAGENTA}
"""Coach → its side."""
