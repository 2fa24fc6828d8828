"""Goal area: nobody but the goalkeeper of the side that defends it is in a goal area.

While a goalkeeper is off the field, the first robot of its side that is on it keeps the goal (ours: the rule book lets
teams choose). Another robot of that side is illegal defence, one of the other side illegal attack. The other side gets
a free kick.

Section: play, illegal defence and attack.
Measures: how long the centre of a robot has been inside the outer edges of the area's lines, or in the goal behind it.
Not judged: who pushed it there; a hull that reaches over the line.
"""

from sim_host.referee.game.decision import Decision
from sim_host.referee.rules.foul import exceeds, foul, is_called
from sim_host.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side, out of the area at the nearest restart spot, or nothing."""
    stays, limit = situation.state.evidence.stays.robots, situation.match.book.areas.goal_area_duration
    for stay in stays:
        if exceeds(stay.lasted, limit) and is_called(situation, "goal_area"):
            roster, robot = situation.match.roster, situation.snapshot.robots[stay.robot]
            defends = situation.state.attack(roster.sides[stay.robot]) != stay.end
            name, area = roster.names[stay.robot], "its own" if defends else "the other"
            what = f"illegal {'defence' if defends else 'attack'}"
            text = f"{what}: {name} is in {area} goal area for {stay.lasted:.2f} s, limit {limit:.2f}"
            return foul(
                situation,
                "goal_area",
                (name,),
                text,
                measured=stay.lasted,
                limit=limit,
                unit="s",
                place=(robot.x, robot.y),
            )
    return None
