"""Goal kick for a side: at the restart marker of its half nearest to the ball or to the named place."""

from schemas.game import Phase
from schemas.messages.game import RefereeAction
from sim_host.referee.actions import ordered_restart
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return ordered_restart.why_illegal(draft, action, Phase.GOAL_KICK)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Order the goal kick."""
    ordered_restart.apply(draft, action, Phase.GOAL_KICK)
