"""Undo: restores the state before the last decision or action, with its score and cards; the clock goes on.

Further decisions of the half can be undone after it, the newest first.
"""

from schemas.messages.soccer.game import RefereeAction
from sim_host.soccer.referee import authority
from sim_host.soccer.referee.actions.legality import no_match
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, _action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_match(draft) or authority.why_not_undo(draft)


def apply(draft: RulingDraft, _action: RefereeAction) -> None:
    """Restore the state."""
    authority.undo(draft)
