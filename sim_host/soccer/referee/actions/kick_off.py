"""Kick-off for a side, from the centre mark; before the match, it begins the match with that side."""

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import Phase
from sim_host.soccer.referee.actions import ordered_restart
from sim_host.soccer.referee.actions.legality import no_side, place_is_fixed
from sim_host.soccer.referee.procedures import periods
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    if draft.state.phase is Phase.PRE_GAME:
        return no_side(action) or place_is_fixed(action, Phase.KICK_OFF)
    return ordered_restart.why_illegal(draft, action, Phase.KICK_OFF)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Begin the match, or order the kick-off; after the first kick-off, the other side kicks off the next half."""
    if draft.state.phase is Phase.PRE_GAME and action.side is not None:
        draft.state = draft.state._replace(kick_off=action.side)
        periods.begin_half(draft)
    else:
        ordered_restart.apply(draft, action, Phase.KICK_OFF)
