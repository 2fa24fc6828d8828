"""Enter: a robot that was parked, or whose time off the field is up, comes back in a stoppage.

A league's referee box ends the repair of a robot before its time is up: the robot comes back at once, or by itself in
the next stoppage.
"""

import dataclasses

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import REFBOX, OffField
from sim_host.soccer.referee.actions.legality import named_robot, no_match, no_robot
from sim_host.soccer.referee.procedures import discipline
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_match(draft) or no_robot(draft, action) or _why_not(draft, action)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Bring the robot back."""
    name = named_robot(action)
    if _ends_repair(draft, action):
        participation = draft.state.participation
        absences = {**participation.absences, name: participation.absences[name]._replace(left=0.0)}
        draft.state = draft.state._replace(participation=dataclasses.replace(participation, absences=absences))
        if discipline.why_stays_out(draft, name) is not None:
            return
    discipline.bring_back(draft, action.action, name)


def _why_not(draft: RulingDraft, action: RefereeAction) -> str | None:
    name = named_robot(action)
    if name not in draft.state.participation.absences:
        return f"{name} is on the field"
    return None if _ends_repair(draft, action) else discipline.why_stays_out(draft, name)


def _ends_repair(draft: RulingDraft, action: RefereeAction) -> bool:
    """Whether a referee box ends the repair of this robot."""
    away = draft.state.participation.absences[named_robot(action)]
    return action.source == REFBOX and draft.state.refbox_decides and away.why is OffField.REPAIR
