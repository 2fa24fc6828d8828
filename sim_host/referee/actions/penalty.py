"""Penalty for a side: from the penalty mark of the end that it attacks."""

from schemas.game import Phase
from schemas.messages.game import RefereeAction
from sim_host.referee.actions import ordered_restart
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return ordered_restart.why_illegal(draft, action, Phase.PENALTY)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Order the penalty."""
    ordered_restart.apply(draft, action, Phase.PENALTY)
