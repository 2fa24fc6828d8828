"""Place the ball: places it while the game is halted, and moves the spot of the restart that is due or signalled."""

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import Phase
from sim_host.soccer.referee.actions.legality import FIXED, bad_place, no_half, place_is_fixed
from sim_host.soccer.referee.game.restart import Restart
from sim_host.soccer.referee.placement.clear_ground import has_room
from sim_host.soccer.referee.ruling_draft import RulingDraft
from sim_host.soccer.referee.wording import place_text


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    if draft.state.running:
        return "the game is running; stop it first"
    if action.place is None:
        return "no place is named; name x and y in m, field frame"
    due = _due(draft)
    fixed = place_is_fixed(action, due.phase) if due is not None and due.phase in FIXED else None
    return no_half(draft) or fixed or bad_place(draft, action) or _on_an_obstacle(draft, action)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Place the ball; robots get the full time to take positions around the new spot."""
    if action.place is None:
        return
    spot = (action.place.x, action.place.y)
    draft.place_ball(spot)
    if draft.state.pending is not None:
        draft.state = draft.state._replace(pending=draft.state.pending._replace(spot=spot))
    elif draft.state.phase is not Phase.STOPPED:
        timing = draft.state.timing.restart_timer(draft.state.timing.until)
        draft.state = draft.state._replace(spot=spot, timing=timing)


def _on_an_obstacle(draft: RulingDraft, action: RefereeAction) -> str | None:
    """No obstacle may stand at the place."""
    if action.place is None or has_room(draft.match, draft.snapshot, (action.place.x, action.place.y)):
        return None
    return f"an obstacle stands at {place_text((action.place.x, action.place.y))}; name another place, or remove it"


def _due(draft: RulingDraft) -> Restart | None:
    """The restart that is due or signalled, or None."""
    return draft.state.pending or draft.state.restart
