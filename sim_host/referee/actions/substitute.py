"""Substitution: a robot leaves in a stoppage for good, and a sound one plays on under its name once its time is up.

Cards stay with the name: there is one robot of each number."""

import dataclasses

from schemas.game import OffField, RefereeAction
from sim_host.referee import discipline
from sim_host.referee.actions.legality import named_robot, no_match, no_robot, sent_off
from sim_host.referee.people import Away
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_match(turn) or no_robot(turn, action) or sent_off(turn, action) or _too_late(turn, action)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Take it out, and count."""
    name, people = named_robot(action), turn.state.people
    side = turn.match.roster.side_of(name)
    made = {**people.substitutions, side: people.substitutions.get(side, 0) + 1}
    turn.state = turn.state._replace(people=dataclasses.replace(people, substitutions=made))
    discipline.take_out(turn, action.action, name, Away(OffField.SUBSTITUTION, turn.book.people.substitution))


def _too_late(turn: Turn, action: RefereeAction) -> str | None:
    """In a stoppage, and so many in a match."""
    if turn.state.running:
        return "the game is running; stop it first"
    side, limit = turn.match.roster.side_of(named_robot(action)), turn.book.people.substitutions
    made = turn.state.people.substitutions.get(side, 0)
    return None if made < limit else f"{side} has made {made} substitutions, {limit} are allowed"
