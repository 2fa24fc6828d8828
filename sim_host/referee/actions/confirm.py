"""Confirm: what the referee has proposed is decided at once."""

from schemas.game import RefereeAction
from sim_host.referee import authority
from sim_host.referee.actions.legality import no_proposal
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, _action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_proposal(turn)


def apply(turn: Turn, _action: RefereeAction) -> None:
    """Carry it out."""
    proposal = turn.state.proposal
    if proposal is not None:
        authority.decide(turn, proposal.rule, proposal.decision)
