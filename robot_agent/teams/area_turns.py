"""Turns in the penalty areas: a field robot waits outside while as many teammates as the rules allow are inside."""

import math

from robot_agent.fair_play import RuleLimits
from robot_agent.skills.keep_out import Area
from robot_agent.world_model import WorldBelief


def must_wait(belief: WorldBelief, area: Area, limits: RuleLimits, keeper: str | None) -> bool:
    """Whether as many teammates as allowed are nearer to the ball than this robot, and in the nearer penalty area.

    Where one more robot there is a foul at once, the teammates may be anywhere, since they may be about to enter.
    """
    if belief.holding and limits.area_robots:
        return False
    end = math.copysign(1.0, belief.me.x)
    ball = belief.ball.now[:2] if belief.ball is not None else (end * area.goal_line, 0.0)
    mine = math.dist(ball, belief.me[:2])
    nearer = sum(
        math.dist(ball, mate.body[:2]) < mine and (limits.at_once or area.has(end, *mate.body[:2]))
        for name, mate in belief.mates.items()
        if name != keeper
    )
    return nearer >= limits.area_robots
