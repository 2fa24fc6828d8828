"""Stop: halts the game at once; how it goes on is then for people to say, with a restart or with start.

In a shoot-out it ends the attempt that is on, without a goal; before START it changes nothing there but the time.
"""

from schemas.game import EventKind, Phase, RefereeAction, Stage
from sim_host.referee import flow, restart
from sim_host.referee.actions.legality import no_half
from sim_host.referee.decision import Decision
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, _action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return "the game is stopped already" if turn.state.phase is Phase.STOPPED else no_half(turn)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Halt the game."""
    state = turn.state
    if state.stage is not Stage.SHOOT_OUT:
        restart.stop(turn, action.action, None)
    elif state.running:
        text = f"penalty of {state.side} ended without a goal by the word of {action.source}"
        flow.carry_out(turn, action.action, Decision(EventKind.SHOT, text, shot_scored=False, side=state.side))
    else:
        restart.stop(turn, action.action, state.restart)
