"""Penalty for a side: from the penalty mark of the end it attacks."""

from schemas.game import Phase, RefereeAction
from sim_host.referee.actions import ordered_restart
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return ordered_restart.why_illegal(draft, action, Phase.PENALTY)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Order it."""
    ordered_restart.apply(draft, action, Phase.PENALTY)
