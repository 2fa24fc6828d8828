"""Substitution: a robot leaves in a stoppage for good, and a sound one plays on under its name once its time is up.

Cards stay with the name: there is one robot of each number."""

import dataclasses

from schemas.game import OffField, RefereeAction
from sim_host.referee.actions.legality import named_robot, no_match, no_robot, sent_off
from sim_host.referee.game.participation import Absence
from sim_host.referee.procedures import discipline
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_match(draft) or no_robot(draft, action) or sent_off(draft, action) or _too_late(draft, action)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Take it out, and count."""
    name, participation = named_robot(action), draft.state.participation
    side = draft.match.roster.side_of(name)
    made = {**participation.substitutions, side: participation.substitutions.get(side, 0) + 1}
    draft.state = draft.state._replace(participation=dataclasses.replace(participation, substitutions=made))
    discipline.take_out(draft, action.action, name, Absence(OffField.SUBSTITUTION, draft.book.people.substitution))


def _too_late(draft: RulingDraft, action: RefereeAction) -> str | None:
    """In a stoppage, and so many in a match."""
    if draft.state.running:
        return "the game is running; stop it first"
    side, limit = draft.match.roster.side_of(named_robot(action)), draft.book.people.substitutions
    made = draft.state.participation.substitutions.get(side, 0)
    return None if made < limit else f"{side} has made {made} substitutions, {limit} are allowed"
