"""Start: moves the game on by one step, whatever it is waiting for.

Before the match it signals the first kick-off; in the break, or while robots park, that of the next half. It gives
START of a signalled restart at once, also while robots are in wrong positions. After STOP it signals the restart that
is due without waiting any longer. If none is due, because people stopped the game, it signals a drop ball where the
ball is, the kick-off if the half has not begun, or the next penalty of a shoot-out.
"""

from collections.abc import Callable, Mapping

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import RESTARTS, GameStage, Phase
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.procedures import penalties, periods, restart
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, _action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    state = draft.state
    if state.running:
        return "the game is running"
    if state.phase not in STEPS:
        return f"nothing can be started, the phase is {state.phase}"
    drift = draft.match.book.restarts.drift
    if state.restart is not None and restart.from_spot(draft, state.restart) > drift:
        away = restart.from_spot(draft, state.restart)
        return f"the ball is {away:.2f} m from its spot, at most {drift:.2f} m allowed; it is being put back"
    return None


def apply(draft: RulingDraft, _action: RefereeAction) -> None:
    """Move the game on."""
    STEPS[draft.state.phase](draft)


def _after_stop(draft: RulingDraft) -> None:
    due = draft.state.pending
    out = draft.state.shoot_out
    if due is not None:
        restart.signal(draft, due)
    elif draft.state.stage is GameStage.SHOOT_OUT and out is not None:
        restart.signal(draft, penalties.penalty_for(draft, out.next_side()))
    elif draft.state.timing.runs:
        restart.signal(draft, restart_at(draft.match, draft.state, Phase.DROP_BALL, None, draft.ball_spot))
    else:
        periods.begin_half(draft)


def _signalled(draft: RulingDraft) -> None:
    signalled = draft.state.restart
    if signalled is not None:
        restart.start(draft, signalled)


STEPS: Mapping[Phase, Callable[[RulingDraft], None]] = {
    Phase.PRE_GAME: periods.begin_half,
    Phase.PARKING: periods.begin_next_period,
    Phase.HALF_TIME: periods.begin_next_period,
    Phase.STOPPED: _after_stop,
} | dict.fromkeys(RESTARTS, _signalled)
"""Phase → the effect of START in it."""
