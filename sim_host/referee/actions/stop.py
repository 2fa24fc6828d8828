"""Stop: halts the game at once; how it goes on is then for people to say, with a restart or with start."""

from schemas.game import Phase, RefereeAction
from sim_host.referee import restart
from sim_host.referee.actions.legality import no_half
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, _action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return "the game is stopped already" if turn.state.phase is Phase.STOPPED else no_half(turn)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Halt the game."""
    restart.stop(turn, action.action, None)
