"""Yellow card for a robot, whichever it is; so many of them send it off as the rule book says."""

from schemas.game import Card, RefereeAction
from sim_host.referee import discipline
from sim_host.referee.actions.legality import named_robot, no_match, no_robot, sent_off
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_match(turn) or no_robot(turn, action) or sent_off(turn, action)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Show it."""
    discipline.show(turn, action.action, named_robot(action), Card.YELLOW)
