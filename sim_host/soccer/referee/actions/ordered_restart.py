"""The restart actions: whether one is legal, and how it enters the restart sequence; a kick-off can do more."""

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import SIDED, Phase
from sim_host.soccer.referee.actions.action import Action
from sim_host.soccer.referee.actions.legality import (
    FIXED,
    bad_place,
    has_side,
    in_shoot_out,
    no_half,
    no_side,
    place_is_fixed,
)
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.procedures import restart
from sim_host.soccer.referee.ruling_draft import RulingDraft


def restart_action(phase: Phase) -> Action:
    """The action that orders this restart."""
    return Action(
        lambda draft, action: why_illegal(draft, action, phase), lambda draft, action: apply(draft, action, phase)
    )


def why_illegal(draft: RulingDraft, action: RefereeAction, phase: Phase) -> str | None:
    """Why this restart cannot be ordered now, or None."""
    return (
        no_half(draft)
        or (in_shoot_out(draft) if phase is not Phase.PENALTY else None)
        or (no_side(action) if phase in SIDED else has_side(action))
        or (place_is_fixed(action, phase) if phase in FIXED else bad_place(draft, action))
    )


def apply(draft: RulingDraft, action: RefereeAction, phase: Phase) -> None:
    """Stop the game if it is not stopped, and let this restart follow in place of any other.

    The named place, or else the place of the ball, determines the spot.
    """
    place = (action.place.x, action.place.y) if action.place is not None else draft.ball_spot
    ordered = restart_at(draft.match, draft.state, phase, action.side, place)
    if draft.state.phase is Phase.STOPPED:
        timing = draft.state.timing._replace(until=draft.book.restarts.stop_to_signal)
        draft.state = draft.state._replace(pending=ordered, timing=timing)
    else:
        restart.stop(draft, action.action, ordered)
