"""Overrule: the referee's proposal is dropped, and the game goes on."""

from schemas.messages.game import RefereeAction
from sim_host.referee.actions.legality import no_proposal
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, _action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_proposal(draft)


def apply(draft: RulingDraft, _action: RefereeAction) -> None:
    """Drop the proposal."""
    draft.state = draft.state._replace(proposal=None)
