"""The penalty areas, in which few field robots of a side may be at a time, and for a while."""

import math

from robot_agent.sdk.skills.keep_out import Area
from robot_agent.sdk.world_model import WorldBelief
from robot_agent.teams.fair_play import RuleLimits
from schemas.soccer.game import TeamPhase

LEAVES_BEFORE = 2.0
"""s before its time is up, when a robot leaves."""
COMES_BACK = 0.5
"""Share of its time that has to be left before it enters again."""


class AreaTurn:
    """When one robot that keeps no goal has to be outside the penalty areas."""

    def __init__(self, limits: RuleLimits, area: Area) -> None:
        self._limits = limits
        self._area = area
        self._time = 0.0
        """s in a penalty area; outside it runs down as fast."""
        self._is_used_up = False

    def has_to_be_out(self, belief: WorldBelief, keeper: str | None) -> bool:
        """Whether the robot has to leave the nearer penalty area, or stay out of it, after one more sight."""
        inside = self._has(belief, *belief.me[:2])
        self._time = max(0.0, self._time + (belief.dt if inside else -belief.dt))
        if self._time > self._limits.stay - LEAVES_BEFORE:
            self._is_used_up = True
        elif self._time < (1.0 - COMES_BACK) * self._limits.stay:
            self._is_used_up = False
        return self._is_used_up or self._is_one_too_many(belief, keeper, inside)

    def _is_one_too_many(self, belief: WorldBelief, keeper: str | None, inside: bool) -> bool:
        """Whether as many teammates as allowed are nearer to the ball than this robot, and in the nearer penalty area.

        Where one more robot there is a foul at once, the teammates may be anywhere, since they may be about to enter,
        and this robot waits outside until one of those inside has left, also with the ball.
        """
        allowed, at_once = self._limits.area_robots, self._limits.at_once
        ball = belief.ball.now[:2] if belief.ball is not None else (_end(belief) * self._area.goal_line, 0.0)
        mine = math.dist(ball, belief.me[:2])
        there = nearer = 0
        for name, mate in belief.mates.items():
            if name == keeper:
                continue
            is_there = self._has(belief, *mate.body[:2])
            there += is_there
            nearer += math.dist(ball, mate.body[:2]) < mine and (at_once or is_there)
        if at_once and not inside and there >= allowed:
            return True
        return nearer >= allowed and not (belief.holding and allowed)

    def _has(self, belief: WorldBelief, x: float, y: float) -> bool:
        return self._area.has(_end(belief), x, y)


def leaves(belief: WorldBelief, areas: Area) -> bool:
    """Whether a robot is in an area on its way to a place of a restart, which is outside: its own way leads out."""
    game, me = belief.game, belief.me
    takes_place = game.phase.ours or game.phase.theirs or game.phase is TeamPhase.DROP_BALL
    return takes_place and not game.running and areas.has(_end(belief), me.x, me.y)


def _end(belief: WorldBelief) -> float:
    """The sign of the x of the nearer goal."""
    return math.copysign(1.0, belief.me.x)
