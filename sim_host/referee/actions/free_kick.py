"""Free kick for a side: where the ball lies or at the place named, out of penalty areas."""

from schemas.game import Phase, RefereeAction
from sim_host.referee.actions import ordered_restart
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return ordered_restart.why_illegal(draft, action, Phase.FREE_KICK)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Order it."""
    ordered_restart.apply(draft, action, Phase.FREE_KICK)
