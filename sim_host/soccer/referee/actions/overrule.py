"""Overrule: the referee's proposal is dropped, and the game goes on.

Robots that left their places at a penalty are forgotten: the same proposal would be made again.
"""

from schemas.messages.soccer.game import RefereeAction
from sim_host.soccer.referee.actions.legality import no_proposal
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, _action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_proposal(draft)


def apply(draft: RulingDraft, _action: RefereeAction) -> None:
    """Drop the proposal."""
    piece = draft.state.set_piece
    if piece is not None and piece.strays:
        piece = piece._replace(strays=())
    draft.state = draft.state._replace(proposal=None, set_piece=piece)
