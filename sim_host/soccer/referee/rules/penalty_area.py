"""Penalty area: one robot of each side, besides the goalkeeper in its own area, may be in a penalty area for a while.

More robots of the defending side, or one for too long, commit illegal defence; of the attacking side, illegal attack.
The opponents of the offenders get a free kick.

Section: play, illegal defence and attack.
Measures: the time for which more robots of one side than allowed have had their centres in the area, even if the robots
changed, and the time of each robot. Outside, both run down, and do not begin anew. Of too
many robots, the one that came last is named first, of those that came together the one farthest from the ball. While an
opponent pushes a robot in, and for half a second after an opponent has hit it, its time runs down.
Not judged: how a robot that was pushed there leaves.
"""

import math
from collections.abc import Sequence
from functools import partial

from sim_host.soccer.referee.evidence.stays import Crowd, Stay
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.offence_order import worst_first
from sim_host.soccer.referee.rules.foul import exceeds, foul, is_called
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side, at the restart spot nearest to the area, or None."""
    stays, areas = situation.state.evidence.stays, situation.match.book.areas
    crowds = [crowd for crowd in stays.crowds if crowd.inside and exceeds(crowd.lasted, areas.penalty_area_duration)]
    visits = [visit for visit in stays.visits if visit.inside and exceeds(visit.lasted, areas.penalty_area_stay)]
    if not (crowds or visits) or not is_called(situation, "penalty_area"):
        return None
    return _too_many(situation, _first(situation, crowds)) if crowds else _too_long(situation, visits)


def _first(situation: Situation, crowds: Sequence[Crowd]) -> Crowd:
    """The crowd to call: where each robot has a clock, the oldest; of two as old, that nearer to the ball, attackers
    before defenders, so that neither colour is preferred."""
    if not situation.match.book.areas.penalty_area_stay:
        return worst_first(
            situation,
            crowds,
            lambda crowd: crowd.lasted,
            lambda crowd: min(crowd.robots, key=partial(_from_ball, situation)),
        )[0]
    ball = situation.snapshot.ball
    return min(
        crowds, key=lambda crowd: (-crowd.lasted, -crowd.end * ball.x, _defends(situation, crowd.robots[0], crowd.end))
    )


def _too_many(situation: Situation, crowd: Crowd) -> Decision:
    areas, roster = situation.match.book.areas, situation.match.roster
    since = {(visit.robot, visit.end): visit.lasted for visit in situation.state.evidence.stays.visits}
    offender = min(crowd.robots, key=lambda index: (since.get((index, crowd.end), 0.0), -_from_ball(situation, index)))
    names = tuple(
        [roster.names[index] for index in (offender, *(other for other in crowd.robots if other != offender))]
    )
    text = (
        f"{_offence(situation, offender, crowd.end)}: {' and '.join(names)} in a penalty area, at most "
        f"{areas.penalty_area_robots} of a side allowed, for {crowd.lasted:.1f} s, "
        f"limit {areas.penalty_area_duration:.1f}"
    )
    return _foul(situation, offender, names, text, crowd.lasted, areas.penalty_area_duration)


def _too_long(situation: Situation, visits: Sequence[Stay]) -> Decision:
    limit = situation.match.book.areas.penalty_area_stay
    in_order = worst_first(situation, visits, lambda visit: visit.lasted, lambda visit: visit.robot)
    visit = max(in_order, key=lambda visit: (visit.lasted, _from_ball(situation, visit.robot)))
    name = situation.match.roster.names[visit.robot]
    text = (
        f"{_offence(situation, visit.robot, visit.end)}: {name} in a penalty area for {visit.lasted:.1f} s, "
        f"limit {limit:.1f}"
    )
    return _foul(situation, visit.robot, (name,), text, visit.lasted, limit)


def _foul(
    situation: Situation, offender: int, names: tuple[str, ...], text: str, lasted: float, limit: float
) -> Decision:
    robot = situation.snapshot.robots[offender]
    return foul(situation, "penalty_area", names, text, (lasted, limit, "s"), (robot.x, robot.y))


def _offence(situation: Situation, index: int, end: int) -> str:
    return f"illegal {'defence' if _defends(situation, index, end) else 'attack'}"


def _defends(situation: Situation, index: int, end: int) -> bool:
    return situation.state.attack(situation.match.roster.sides[index]) != end


def _from_ball(situation: Situation, index: int) -> float:
    """m between the centres of a robot and the ball."""
    robot, ball = situation.snapshot.robots[index], situation.snapshot.ball
    return math.hypot(robot.x - ball.x, robot.y - ball.y)
