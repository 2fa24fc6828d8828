"""Penalty area: only one robot of each side, besides the goalkeeper in its own area, may stay in a penalty area.

More robots of the defending side commit illegal defence, more of the attacking side illegal attack. The opponents of
the offenders get a free kick.

Section: play, illegal defence and attack.
Measures: the time for which more robots of one side than allowed have had their centres in the area, even if the robots
changed. The one farthest from the ball is named first.
Not judged: which of them came last, and whether one was pushed there.
"""

import math

from sim_host.referee.game.decision import Decision
from sim_host.referee.offence_order import worst_first
from sim_host.referee.rules.foul import exceeds, foul, is_called
from sim_host.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side, at the restart spot nearest to the area, or None."""
    crowds, areas = situation.state.evidence.stays.crowds, situation.match.book.areas
    limit = areas.penalty_area_duration
    for crowd in worst_first(
        situation, crowds, lambda crowd: crowd.lasted, lambda crowd: _farthest(situation, crowd.robots)
    ):
        if exceeds(crowd.lasted, limit) and is_called(situation, "penalty_area"):
            roster, farthest = situation.match.roster, _farthest(situation, crowd.robots)
            order = (farthest, *(index for index in crowd.robots if index != farthest))
            names = tuple([roster.names[index] for index in order])
            defends = situation.state.attack(roster.sides[farthest]) != crowd.end
            text = (
                f"illegal {'defence' if defends else 'attack'}: {' and '.join(names)} in a penalty area, at most "
                f"{areas.penalty_area_robots} of a side allowed, for {crowd.lasted:.1f} s, limit {limit:.1f}"
            )
            at = situation.snapshot.robots[farthest]
            return foul(
                situation, "penalty_area", names, text, measured=crowd.lasted, limit=limit, unit="s", place=(at.x, at.y)
            )
    return None


def _farthest(situation: Situation, crowd: tuple[int, ...]) -> int:
    """The robot that is farthest from the ball."""
    robots, ball = situation.snapshot.robots, situation.snapshot.ball
    return max(crowd, key=lambda index: math.hypot(robots[index].x - ball.x, robots[index].y - ball.y))
