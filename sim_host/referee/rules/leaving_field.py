"""Leaving the field: a robot that takes part stays on the field; the other side gets a free kick.

Section: play; the rule book lets a robot leave with the referee's leave alone, for repair, substitution or a card.
Measures: how long the whole hull of a robot has been outside the lines, the goals included.
Not judged: why it left, and who pushed it out; robots that the referee has off the field.
"""

from sim_host.referee.decision import Decision
from sim_host.referee.rules.foul import exceeds, foul, is_called
from sim_host.referee.scene import Scene


def judge(scene: Scene) -> Decision | None:
    """A free kick for the other side where the ball is, or nothing."""
    limit = scene.match.book.contact.outside_duration
    for index, lasted in scene.state.evidence.outside:
        name = scene.match.roster.names[index]
        if exceeds(lasted, limit) and name not in scene.state.people.away and is_called(scene, "leaving_field"):
            robot = scene.snapshot.robots[index]
            text = f"{name} is outside the field for {lasted:.1f} s, limit {limit:.1f}"
            return foul(
                scene, "leaving_field", (name,), text, measured=lasted, limit=limit, unit="s", place=(robot.x, robot.y)
            )
    return None
