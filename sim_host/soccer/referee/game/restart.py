"""A restart: its kind, the side that takes it, and its spot."""

from typing import NamedTuple

from schemas.side import Side
from schemas.soccer.game import Phase

Spot = tuple[float, float]
"""A point on the ground: x and y in m, field frame."""
CENTRE: Spot = (0.0, 0.0)


class Restart(NamedTuple):
    """A way to bring the ball back into play: its kind, the side that takes it (None for a drop ball), and its spot."""

    phase: Phase
    side: Side | None
    spot: Spot


def kick_off_after_goal(scorers: Side) -> Restart:
    """The kick-off by the side that conceded."""
    return Restart(Phase.KICK_OFF, scorers.opponent, CENTRE)
