"""End the half: at once, before its time is up; after the last half the match is over."""

from schemas.game import RefereeAction
from sim_host.referee import flow
from sim_host.referee.actions.legality import a_shoot_out, no_half
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, _action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_half(turn) or a_shoot_out(turn)


def apply(turn: Turn, action: RefereeAction) -> None:
    """End the half."""
    state = turn.state
    flow.end_half(
        turn, action.action, f"half {state.half} ended after {state.clock:.1f} s of play, asked by {action.source}"
    )
