"""The number of robots that a rule book allows of a side."""

from collections.abc import Sequence

from schemas.config.roster import RosterEntry
from schemas.config.soccer.rule_book import SHIPPED, RuleBook, load_rule_book
from schemas.errors import TouchlineError
from schemas.side import Side


def check_team_sizes(robots: Sequence[RosterEntry], book: RuleBook) -> None:
    """Check that no side has more robots than the rule book allows.

    Raises:
        TouchlineError: a side has; names the rule books that allow as many.
    """
    most = book.people.most_robots
    for side in Side:
        count = sum(robot.side is side for robot in robots)
        if count > most:
            wider = [name for name in SHIPPED if load_rule_book(name).people.most_robots >= count]
            remedy = f"; {count} are allowed by {', '.join(wider)}" if wider else ""
            raise TouchlineError(f"{side} has {count} robots; the rules {book.name} allow {most} of a side{remedy}")
