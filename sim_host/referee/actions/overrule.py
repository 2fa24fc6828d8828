"""Overrule: what the referee has proposed is not decided; the game goes on."""

from schemas.game import RefereeAction
from sim_host.referee.actions.legality import no_proposal
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, _action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_proposal(draft)


def apply(draft: RulingDraft, _action: RefereeAction) -> None:
    """Forget it."""
    draft.state = draft.state._replace(proposal=None)
