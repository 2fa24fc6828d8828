"""Repair: a robot leaves the field, and comes back at a stoppage once its time is up."""

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import OffField
from sim_host.soccer.referee.actions.legality import is_away, named_robot, no_match, no_robot, off_field
from sim_host.soccer.referee.game.participation import Absence
from sim_host.soccer.referee.procedures import discipline
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_match(draft) or no_robot(draft, action) or off_field(draft, action) or _too_many(draft, action)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Take the robot off the field."""
    discipline.take_out(draft, action.action, named_robot(action), Absence(OffField.REPAIR, draft.book.people.repair))


def _too_many(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Only a limited number of robots of a side may be in repair at the same time, and never its last on the field."""
    roster, limit = draft.match.roster, draft.book.people.repairs_at_once
    side = roster.side_of(named_robot(action))
    on_field = [name for name in roster.names if roster.side_of(name) is side and not is_away(draft, name)]
    if on_field == [action.robot]:
        return f"{action.robot} is the last robot of {side} on the field"
    repaired = [
        name
        for name, away in draft.state.participation.absences.items()
        if away.why is OffField.REPAIR and name in roster.names and roster.side_of(name) is side
    ]
    return None if len(repaired) < limit else f"{len(repaired)} robots of {side} are in repair, which is the limit"
