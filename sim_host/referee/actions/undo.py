"""Undo: the state before the last decision or action comes back, score and cards with it; the clock goes on."""

from schemas.game import RefereeAction
from sim_host.referee import authority
from sim_host.referee.actions.legality import no_match
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, _action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_match(turn) or authority.why_not_undo(turn)


def apply(turn: Turn, _action: RefereeAction) -> None:
    """Bring it back."""
    authority.undo(turn)
