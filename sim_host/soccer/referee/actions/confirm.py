"""Confirm: the referee's proposal is decided at once."""

from schemas.messages.soccer.game import RefereeAction
from sim_host.soccer.referee import authority
from sim_host.soccer.referee.actions.legality import no_proposal
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, _action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_proposal(draft)


def apply(draft: RulingDraft, _action: RefereeAction) -> None:
    """Carry out the proposal."""
    proposal = draft.state.proposal
    if proposal is not None:
        authority.decide(draft, proposal.rule, proposal.decision)
