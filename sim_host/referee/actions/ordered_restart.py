"""What the seven restart actions share: who may order one, and how it enters the restart sequence."""

from schemas.game import SIDED, Phase, RefereeAction
from sim_host.referee import restart
from sim_host.referee.actions.legality import FIXED, a_place, a_shoot_out, a_side, bad_place, no_half, no_side
from sim_host.referee.spots import restart_at
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, action: RefereeAction, phase: Phase) -> str | None:
    """A reason against ordering this restart, or nothing."""
    return (
        no_half(turn)
        or (a_shoot_out(turn) if phase is not Phase.PENALTY else None)
        or (no_side(action) if phase in SIDED else a_side(action))
        or (a_place(action, phase) if phase in FIXED else bad_place(turn, action))
    )


def apply(turn: Turn, action: RefereeAction, phase: Phase) -> None:
    """Stop the game if it is not stopped, with this restart to follow in place of any other.

    The spot follows from the place named, or from where the ball lies.
    """
    place = (action.place.x, action.place.y) if action.place is not None else turn.ball_spot
    ordered = restart_at(turn.match, turn.state, phase, action.side, place)
    if turn.state.phase is Phase.STOPPED:
        timing = turn.state.timing._replace(until=turn.book.restarts.stop_to_signal)
        turn.state = turn.state._replace(pending=ordered, timing=timing)
    else:
        restart.stop(turn, action.action, ordered)
