"""Overrule: what the referee has proposed is not decided; the game goes on."""

from schemas.game import RefereeAction
from sim_host.referee.actions.legality import no_proposal
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, _action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_proposal(turn)


def apply(turn: Turn, _action: RefereeAction) -> None:
    """Forget it."""
    turn.state = turn.state._replace(proposal=None)
