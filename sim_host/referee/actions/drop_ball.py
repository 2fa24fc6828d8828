"""Drop ball: where the ball lies or at the place named, out of penalty areas."""

from schemas.game import Phase, RefereeAction
from sim_host.referee.actions import ordered_restart
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return ordered_restart.why_illegal(turn, action, Phase.DROP_BALL)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Order it."""
    ordered_restart.apply(turn, action, Phase.DROP_BALL)
