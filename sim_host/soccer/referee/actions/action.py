"""What an action consists of."""

from collections.abc import Callable
from dataclasses import dataclass

from schemas.messages.soccer.game import RefereeAction
from sim_host.soccer.referee.ruling_draft import RulingDraft


@dataclass(frozen=True, slots=True)
class Action:
    """One row: a check whether the action is legal in this tick, and its effect."""

    why_illegal: Callable[[RulingDraft, RefereeAction], str | None]
    apply: Callable[[RulingDraft, RefereeAction], None]
    can_be_undone: bool = True
    """It is a decision; the other actions only let the game go on, or decide on a proposal."""
