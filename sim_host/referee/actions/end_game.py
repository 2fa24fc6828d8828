"""End the game: full time at once, from any phase."""

from schemas.game import Phase, RefereeAction
from sim_host.referee import ending
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, _action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return "the match is over already" if turn.state.phase is Phase.FULL_TIME else None


def apply(turn: Turn, action: RefereeAction) -> None:
    """End the match."""
    ending.end_match(turn, action.action, f"match ended at {turn.state.clock:.1f} s of play, asked by {action.source}")
