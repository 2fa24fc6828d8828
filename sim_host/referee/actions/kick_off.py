"""Kick-off for a side: from the centre; before the match, it begins the match with that side."""

from schemas.game import Phase, RefereeAction
from sim_host.referee import flow
from sim_host.referee.actions import ordered_restart
from sim_host.referee.actions.legality import a_place, no_side
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    if turn.state.phase is Phase.PRE_GAME:
        return no_side(action) or a_place(action, Phase.KICK_OFF)
    return ordered_restart.why_illegal(turn, action, Phase.KICK_OFF)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Begin the match, or order the kick-off; the other side of the first one kicks off the next half."""
    if turn.state.phase is Phase.PRE_GAME and action.side is not None:
        turn.state = turn.state._replace(kick_off=action.side)
        flow.begin_half(turn)
    else:
        ordered_restart.apply(turn, action, Phase.KICK_OFF)
