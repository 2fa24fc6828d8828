"""Enter: a robot that was parked, or whose time off the field is up, comes back in a stoppage."""

from schemas.messages.game import RefereeAction
from sim_host.referee.actions.legality import named_robot, no_match, no_robot
from sim_host.referee.procedures import discipline
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_match(draft) or no_robot(draft, action) or _why_not(draft, named_robot(action))


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Bring the robot back."""
    discipline.bring_back(draft, action.action, named_robot(action))


def _why_not(draft: RulingDraft, name: str) -> str | None:
    if name not in draft.state.participation.absences:
        return f"{name} is on the field"
    return discipline.why_stays_out(draft, name)
