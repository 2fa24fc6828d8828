"""Substitution: in a stoppage, a robot leaves the field for good, and another plays on under its name after some time.

Cards stay with the name: there is one robot of each number.
"""

import dataclasses

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import OffField
from sim_host.soccer.referee.actions.legality import named_robot, no_match, no_robot, sent_off, suspended
from sim_host.soccer.referee.game.participation import Absence
from sim_host.soccer.referee.procedures import discipline
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return (
        no_match(draft)
        or no_robot(draft, action)
        or sent_off(draft, action)
        or suspended(draft, action)
        or _is_out(draft, action)
        or _too_late(draft, action)
    )


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Take the robot off the field, and count the substitution."""
    name, participation = named_robot(action), draft.state.participation
    side = draft.match.roster.side_of(name)
    made = {**participation.substitutions, side: participation.substitutions.get(side, 0) + 1}
    draft.state = draft.state._replace(participation=dataclasses.replace(participation, substitutions=made))
    discipline.take_out(draft, action.action, name, Absence(OffField.SUBSTITUTION, draft.book.people.substitution))


def _is_out(draft: RulingDraft, action: RefereeAction) -> str | None:
    """A substitution that is under way is not begun again."""
    name = named_robot(action)
    absence = draft.state.participation.absences.get(name)
    if absence is None or absence.why is not OffField.SUBSTITUTION:
        return None
    left = f", {absence.left:.0f} s left" if absence.left is not None else ""
    return f"{name} is being substituted already{left}"


def _too_late(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Substitutions are allowed in a stoppage only, and limited in a match."""
    if draft.state.running:
        return "the game is running; stop it first"
    side, limit = draft.match.roster.side_of(named_robot(action)), draft.book.people.substitutions
    made = draft.state.participation.substitutions.get(side, 0)
    return None if made < limit else f"{side} has made {made} substitutions, {limit} are allowed"
