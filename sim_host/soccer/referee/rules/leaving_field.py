"""Leaving the field: a robot that takes part must stay on the field. Otherwise the other side gets a free kick.

Section: play; a robot may leave only with the referee's permission, for repair, substitution or a card.
Measures: the time for which the whole hull of a robot has been outside the lines, also in a goal. On the field the time
runs down, and does not begin anew.
Not judged: why it left, and whether it was pushed out; robots that are off the field by decision of the referee.
"""

from sim_host.soccer.referee.evidence.zones import is_outside
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.offence_order import worst_first
from sim_host.soccer.referee.rules.foul import exceeds, foul, is_called
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side where the ball is, or None."""
    limit = situation.match.book.contact.outside_duration
    outside = situation.state.evidence.outside
    for index, lasted in worst_first(situation, outside, lambda one: one[1], lambda one: one[0]):
        name, robot = situation.match.roster.names[index], situation.snapshot.robots[index]
        if (
            exceeds(lasted, limit)
            and is_outside(situation.match, index, robot.x, robot.y)
            and name not in situation.state.participation.absences
            and is_called(situation, "leaving_field")
        ):
            text = f"{name} has been outside the field for {lasted:.1f} s, limit {limit:.1f}"
            return foul(situation, "leaving_field", (name,), text, (lasted, limit, "s"), (robot.x, robot.y))
    return None
