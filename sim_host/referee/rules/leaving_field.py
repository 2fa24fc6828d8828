"""Leaving the field: a robot that takes part stays on the field; the other side gets a free kick.

Section: play; the rule book lets a robot leave with the referee's leave alone, for repair, substitution or a card.
Measures: how long the whole hull of a robot has been outside the lines, the goals included.
Not judged: why it left, and who pushed it out; robots that the referee has off the field.
"""

from sim_host.referee.game.decision import Decision
from sim_host.referee.rules.foul import exceeds, foul, is_called
from sim_host.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side where the ball is, or nothing."""
    limit = situation.match.book.contact.outside_duration
    for index, lasted in situation.state.evidence.outside:
        name = situation.match.roster.names[index]
        if (
            exceeds(lasted, limit)
            and name not in situation.state.participation.absences
            and is_called(situation, "leaving_field")
        ):
            robot = situation.snapshot.robots[index]
            text = f"{name} is outside the field for {lasted:.1f} s, limit {limit:.1f}"
            return foul(
                situation,
                "leaving_field",
                (name,),
                text,
                measured=lasted,
                limit=limit,
                unit="s",
                place=(robot.x, robot.y),
            )
    return None
