"""Overrule: the referee's proposal is dropped, and the game goes on.

Robots in wrong places at a restart are forgotten, and the clocks of fouls and of a ball without progress begin anew:
the same proposal would be made again in the next tick. Touches of the ball stay.
"""

from schemas.messages.soccer.game import RefereeAction
from sim_host.soccer.referee.actions.legality import no_proposal
from sim_host.soccer.referee.evidence import NO_EVIDENCE
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, _action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_proposal(draft)


def apply(draft: RulingDraft, _action: RefereeAction) -> None:
    """Drop the proposal."""
    state = draft.state
    piece = None if state.set_piece is None else state.set_piece._replace(strays=(), intrusions=None)
    seen = NO_EVIDENCE._replace(play=state.evidence.play)
    draft.state = state._replace(proposal=None, set_piece=piece, evidence=seen, still=0.0)
