"""Repair: a robot leaves the field, and comes back at a stoppage once its time is up."""

from schemas.game import OffField, RefereeAction
from sim_host.referee import discipline
from sim_host.referee.actions.legality import named_robot, no_match, no_robot, off_field
from sim_host.referee.people import Away
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_match(turn) or no_robot(turn, action) or off_field(turn, action) or _too_many(turn, action)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Take it out."""
    discipline.take_out(turn, action.action, named_robot(action), Away(OffField.REPAIR, turn.book.people.repair))


def _too_many(turn: Turn, action: RefereeAction) -> str | None:
    """So many robots of a side may be in repair at the same time."""
    roster, limit = turn.match.roster, turn.book.people.repairs_at_once
    side = roster.side_of(named_robot(action))
    repaired = [
        name
        for name, away in turn.state.people.away.items()
        if away.why is OffField.REPAIR and name in roster.names and roster.side_of(name) is side
    ]
    return None if len(repaired) < limit else f"{len(repaired)} robots of {side} are in repair, which is the limit"
