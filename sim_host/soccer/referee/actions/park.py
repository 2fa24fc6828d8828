"""Park a robot: it leaves the field until the action `enter` brings it back."""

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import OffField
from sim_host.soccer.referee.actions.legality import named_robot, no_match, no_robot, off_field
from sim_host.soccer.referee.game.participation import Absence
from sim_host.soccer.referee.procedures import discipline
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_match(draft) or no_robot(draft, action) or off_field(draft, action)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Take the robot off the field."""
    discipline.take_out(draft, action.action, named_robot(action), Absence(OffField.PARKED))
