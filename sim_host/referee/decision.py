"""What a rule decides: a fact with its place and robot, and what follows from it."""

from dataclasses import dataclass

from schemas.game import EventKind
from schemas.side import Side
from sim_host.referee.state import Restart, Spot


@dataclass(frozen=True, slots=True)
class Decision:
    """What a rule has found; the game is stopped, then goes on with the restart, or the half ends."""

    kind: EventKind
    text: str
    """One sentence for people, with the measured quantity."""
    restart: Restart | None = None
    """How the game goes on; nothing when the half ends."""
    goal_for: Side | None = None
    ends_half: bool = False
    side: Side | None = None
    robot: str | None = None
    place: Spot | None = None
