"""End the game: full time at once, from any phase; a side that the action names forfeits."""

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import Phase
from sim_host.soccer.referee.procedures import ending
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, _action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return "the match is over already" if draft.state.phase is Phase.FULL_TIME else None


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """End the match."""
    if action.side is not None:
        ending.forfeit(draft, action.side, f"by decision of {action.source}")
        return
    ending.end_match(draft, action.action, f"match ended after {draft.state.clock:.1f} s of play by {action.source}")
