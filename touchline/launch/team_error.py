"""Errors for which one team is the reason."""

from schemas.errors import MatchFailedError, TouchlineError
from schemas.side import Side


class TeamError(TouchlineError):
    """The programs of a team cannot be started."""

    def __init__(self, side: Side, reason: str) -> None:
        super().__init__(reason)
        self.side = side


class TeamLeftError(MatchFailedError):
    """A match ended because no robot of a team was left, or came."""

    def __init__(self, side: Side, reason: str, *, has_begun: bool) -> None:
        """`has_begun` is whether the match had a state."""
        super().__init__(reason)
        self.side = side
        self.has_begun = has_begun
