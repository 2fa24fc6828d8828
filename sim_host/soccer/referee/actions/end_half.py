"""End the half: at once, before its time is up; after the last half, the match ends."""

from schemas.messages.soccer.game import RefereeAction
from sim_host.soccer.referee.actions.legality import in_shoot_out, no_half
from sim_host.soccer.referee.procedures import periods
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, _action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_half(draft) or in_shoot_out(draft)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """End the half."""
    state = draft.state
    periods.end_half(
        draft, action.action, f"half {state.half} ended after {state.clock:.1f} s of play by {action.source}"
    )
