"""Place the ball: sets it down while the game is halted, and moves the spot of the restart that is due or signalled."""

from schemas.game import Phase, RefereeAction
from sim_host.referee.actions.legality import FIXED, a_place, bad_place, no_half
from sim_host.referee.call import Restart
from sim_host.referee.clear_ground import has_room
from sim_host.referee.turn import Turn
from sim_host.referee.wording import at


def why_illegal(turn: Turn, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    if turn.state.running:
        return "the game is running; stop it first"
    if action.place is None:
        return "no place is named; name x and y in m, field frame"
    due = _due(turn)
    fixed = a_place(action, due.phase) if due is not None and due.phase in FIXED else None
    return no_half(turn) or fixed or bad_place(turn, action) or _on_an_obstacle(turn, action)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Set the ball down; robots get their whole time to take positions around the new spot."""
    if action.place is None:
        return
    spot = (action.place.x, action.place.y)
    turn.place_ball(spot)
    if turn.state.pending is not None:
        turn.state = turn.state._replace(pending=turn.state.pending._replace(spot=spot))
    elif turn.state.phase is not Phase.STOPPED:
        timing = turn.state.timing.anew(turn.state.timing.until)
        turn.state = turn.state._replace(spot=spot, timing=timing)


def _on_an_obstacle(turn: Turn, action: RefereeAction) -> str | None:
    """Nothing that nobody moves may stand where the ball is to lie."""
    if action.place is None or has_room(turn.match, turn.snapshot, (action.place.x, action.place.y)):
        return None
    return f"an obstacle stands at {at((action.place.x, action.place.y))}; name another place, or remove it"


def _due(turn: Turn) -> Restart | None:
    """The restart that will be, or is, signalled."""
    return turn.state.pending or turn.state.restart
