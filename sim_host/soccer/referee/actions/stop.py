"""Stop: halts the game at once; people then decide how it goes on, with a restart or with `start`.

In a shoot-out, it ends the present attempt without a goal; before START of an attempt, it only delays the attempt.
"""

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import EventKind, GameStage, Phase
from sim_host.soccer.referee.actions.legality import no_half
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.procedures import restart
from sim_host.soccer.referee.procedures.decision import carry_out
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, _action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return "the game is stopped already" if draft.state.phase is Phase.STOPPED else no_half(draft)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Halt the game."""
    state = draft.state
    if state.stage is not GameStage.SHOOT_OUT:
        restart.stop(draft, action.action, None)
    elif state.running:
        text = f"penalty of {state.side} ended without a goal, decided by {action.source}"
        carry_out(draft, action.action, Decision(EventKind.SHOT, text, shot_scored=False, side=state.side))
    else:
        restart.stop(draft, action.action, state.restart)
