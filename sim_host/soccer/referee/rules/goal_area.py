"""Goal area: only the goalkeeper of the defending side may stay in a goal area.

While a goalkeeper is off the field, the first robot of its side that is on the field keeps the goal (ours: the rule
book lets teams choose). Any other robot of the defending side commits illegal defence, a robot of the attacking side
illegal attack. The opponents of the offender get a free kick.

Section: play, illegal defence and attack.
Measures: the time for which the centre of a robot has been inside the outer edges of the area's lines, or in the goal
behind it. Outside, the time runs down, and does not begin anew; so it does while an opponent pushes the robot in, and
for half a second after an opponent has hit it.
Not judged: a hull that reaches over the line.
"""

from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.offence_order import worst_first
from sim_host.soccer.referee.rules.foul import exceeds, foul, is_called
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side, at the restart spot nearest to the area, or None."""
    stays, limit = situation.state.evidence.stays.robots, situation.match.book.areas.goal_area_duration
    for stay in worst_first(situation, stays, lambda stay: stay.lasted, lambda stay: stay.robot):
        if stay.inside and exceeds(stay.lasted, limit) and is_called(situation, "goal_area"):
            roster, robot = situation.match.roster, situation.snapshot.robots[stay.robot]
            defends = situation.state.attack(roster.sides[stay.robot]) != stay.end
            name, area = roster.names[stay.robot], "its own" if defends else "the other"
            what = f"illegal {'defence' if defends else 'attack'}"
            text = f"{what}: {name} is in {area} goal area for {stay.lasted:.2f} s, limit {limit:.2f}"
            return foul(situation, "goal_area", (name,), text, (stay.lasted, limit, "s"), (robot.x, robot.y))
    return None
