"""Start: brings the game on by one step, whatever it is waiting for.

Before the match it signals the first kick-off, in the break or while robots park the next half's. Of a signalled
restart it gives START at once, also while robots stand wrong. After STOP it signals the restart that is due without
waiting any longer; when none is due, because people stopped the game, it signals a drop ball where the ball lies, or
the kick-off if the half has not begun.
"""

from collections.abc import Callable, Mapping

from schemas.game import RESTARTS, Phase, RefereeAction
from sim_host.referee import flow, restart
from sim_host.referee.spots import restart_at
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, _action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    state = turn.state
    if state.running:
        return "the game is running"
    if state.phase not in STEPS:
        return f"nothing can be started, the phase is {state.phase}"
    drift = turn.match.book.restarts.drift
    if state.restart is not None and restart.from_spot(turn, state.restart) > drift:
        away = restart.from_spot(turn, state.restart)
        return f"the ball is {away:.2f} m from its spot, at most {drift:.2f} m are allowed; it is being put back"
    return None


def apply(turn: Turn, _action: RefereeAction) -> None:
    """Bring the game on."""
    STEPS[turn.state.phase](turn)


def _after_stop(turn: Turn) -> None:
    due = turn.state.pending
    if due is not None:
        restart.signal(turn, due)
    elif turn.state.timing.runs:
        restart.signal(turn, restart_at(turn.match, turn.state, Phase.DROP_BALL, None, turn.ball_spot))
    else:
        flow.begin_half(turn)


def _signalled(turn: Turn) -> None:
    signalled = turn.state.restart
    if signalled is not None:
        restart.start(turn, signalled)


STEPS: Mapping[Phase, Callable[[Turn], None]] = {
    Phase.PRE_GAME: flow.begin_half,
    Phase.PARKING: flow.go_on,
    Phase.HALF_TIME: flow.go_on,
    Phase.STOPPED: _after_stop,
} | dict.fromkeys(RESTARTS, _signalled)
"""Phase → what START means in it."""
