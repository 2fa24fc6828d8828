"""Throw-in for a side: at the touch line nearer to the ball or to the named place, level with it."""

from schemas.game import Phase
from schemas.messages.game import RefereeAction
from sim_host.referee.actions import ordered_restart
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return ordered_restart.why_illegal(draft, action, Phase.THROW_IN)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Order the throw-in."""
    ordered_restart.apply(draft, action, Phase.THROW_IN)
