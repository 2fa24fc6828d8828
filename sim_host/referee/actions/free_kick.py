"""Free kick for a side: where the ball is or at the named place, outside penalty areas."""

from schemas.game import Phase
from schemas.messages.game import RefereeAction
from sim_host.referee.actions import ordered_restart
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return ordered_restart.why_illegal(draft, action, Phase.FREE_KICK)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Order the free kick."""
    ordered_restart.apply(draft, action, Phase.FREE_KICK)
