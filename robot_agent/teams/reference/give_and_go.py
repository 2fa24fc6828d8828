"""Give and go: a robot that has passed runs on past the opponent before it, for the ball to be returned. Pure."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from robot_agent.sdk.bodies import Body
from robot_agent.soccer.skills.keep_off import inside
from robot_agent.teams.reference.parameters import Parameters
from robot_agent.teams.reference.passing import chance
from schemas.config.sections import Pitch
from schemas.frames import Point

ARRIVED = 0.3
"""m from the end of a run, where it has ended."""


class Run(NamedTuple):
    """A run that a robot has begun."""

    to: Point
    """m."""
    left: float
    """s for which it lasts."""


def run_past(
    me: Body, receiver: Point, opponents: Sequence[Point], pitch: Pitch, front: float, parameters: Parameters
) -> Run | None:
    """The run of a robot that has passed: past the opponent before it; None without such an opponent.

    Of the two sides it takes the one to which the ball is returned more surely.

    Args:
        receiver: where the pass is received.
        front: m; the farthest place of a supporter, before the opponents' penalty area.
    """
    to_goal = math.atan2(-me.y, pitch.goal_line - me.x)
    ux, uy = math.cos(to_goal), math.sin(to_goal)
    before = [place for place in opponents if _is_before(me, place, ux, uy, parameters)]
    if not before:
        return None
    x, y = min(before, key=lambda place: math.dist(me[:2], place))
    beyond, beside = parameters.run_beyond, parameters.run_beside
    ends = [
        inside(x + beyond * ux - side * uy, y + beyond * uy + side * ux, pitch, parameters.support_inset)
        for side in (beside, -beside)
    ]
    to = max(ends, key=lambda end: chance(receiver, end, opponents, parameters))
    return Run(to, parameters.run_lasts) if me.x < to[0] <= front else None


def run_after(before: Run | None, me: Body, dt: float, *, ours: bool) -> Run | None:
    """The run a moment later; None once it has ended.

    Args:
        ours: whether the team has the ball still, or a pass of its own is under way.
    """
    if before is None or not ours or before.left <= dt or math.dist(me[:2], before.to) < ARRIVED:
        return None
    return before._replace(left=before.left - dt)


def _is_before(me: Body, place: Point, ux: float, uy: float, parameters: Parameters) -> bool:
    """Whether an opponent stands between a robot and the goal, near the robot."""
    dx, dy = place[0] - me.x, place[1] - me.y
    along, beside = dx * ux + dy * uy, abs(dy * ux - dx * uy)
    return 0.0 < along < parameters.run_passes and beside < parameters.run_beside
