"""Park a robot: it leaves the field until somebody has it enter."""

from schemas.game import OffField, RefereeAction
from sim_host.referee import discipline
from sim_host.referee.actions.legality import named_robot, no_match, no_robot, off_field
from sim_host.referee.people import Away
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_match(turn) or no_robot(turn, action) or off_field(turn, action)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Take it out."""
    discipline.take_out(turn, action.action, named_robot(action), Away(OffField.PARKED))
