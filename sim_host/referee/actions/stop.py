"""Stop: halts the game at once; how it goes on is then for people to say, with a restart or with start.

In a shoot-out it ends the attempt that is on, without a goal; before START it changes nothing there but the time.
"""

from schemas.game import EventKind, GameStage, Phase, RefereeAction
from sim_host.referee.actions.legality import no_half
from sim_host.referee.game.decision import Decision
from sim_host.referee.procedures import restart
from sim_host.referee.procedures.decision import carry_out
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, _action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return "the game is stopped already" if draft.state.phase is Phase.STOPPED else no_half(draft)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Halt the game."""
    state = draft.state
    if state.stage is not GameStage.SHOOT_OUT:
        restart.stop(draft, action.action, None)
    elif state.running:
        text = f"penalty of {state.side} ended without a goal by the word of {action.source}"
        carry_out(draft, action.action, Decision(EventKind.SHOT, text, shot_scored=False, side=state.side))
    else:
        restart.stop(draft, action.action, state.restart)
