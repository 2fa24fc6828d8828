"""Enter: a robot that was parked, or whose time off is up, comes back in a stoppage."""

from schemas.game import RefereeAction
from sim_host.referee import discipline
from sim_host.referee.actions.legality import named_robot, no_match, no_robot
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_match(turn) or no_robot(turn, action) or _why_not(turn, named_robot(action))


def apply(turn: Turn, action: RefereeAction) -> None:
    """Bring it back."""
    discipline.bring_back(turn, action.action, named_robot(action))


def _why_not(turn: Turn, name: str) -> str | None:
    if name not in turn.state.people.away:
        return f"{name} is on the field"
    return discipline.why_stays_out(turn, name)
