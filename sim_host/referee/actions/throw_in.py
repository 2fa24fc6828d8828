"""Throw-in for a side: on the touch line nearer to the ball or to the place named, level with it."""

from schemas.game import Phase, RefereeAction
from sim_host.referee.actions import ordered_restart
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return ordered_restart.why_illegal(turn, action, Phase.THROW_IN)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Order it."""
    ordered_restart.apply(turn, action, Phase.THROW_IN)
