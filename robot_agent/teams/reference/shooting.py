"""The chance of a shot, along the ground and over the robots. Pure."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from robot_agent.skills.shoot import lane_width
from robot_agent.teams.reference.parameters import Parameters
from schemas.config.sections import Pitch
from schemas.messages.command import KickMode

Point = tuple[float, float]

_GROUND_PLACES = (0.0, -0.4, 0.4, -0.7, 0.7)
"""Where a ground shot may aim, as shares of half the goal's width: 0.25 m inside the posts at most."""
_LOB_PLACES = (-0.55, 0.0, 0.55)
"""Where a lob may aim, as shares of half the goal's width."""
_LOB_ROOM = 0.5
"""m beside a lob's path while it rises, without an opponent."""


class Shot(NamedTuple):
    """A shot that could be taken."""

    mode: KickMode
    target: Point
    chance: float
    """Of a goal, 0 to 1."""


def best_shot(ball: Point, opponents: Sequence[Point], pitch: Pitch, parameters: Parameters) -> Shot | None:
    """The likelier of the best ground shot and the best lob; None out of range."""
    far = math.hypot(pitch.goal_line - ball[0], ball[1])
    if far > parameters.shot_range:
        return None
    keeper = _keeper(opponents, pitch)
    if keeper is None and far > parameters.keeper_unseen:
        keeper = (pitch.goal_line, 0.0)
        opponents = [*opponents, keeper]
    ground = _ground(ball, far, keeper, opponents, pitch, parameters)
    lob = _lob(ball, far, keeper, opponents, pitch, parameters)
    return max((ground, lob), key=lambda shot: shot.chance) if lob is not None else ground


def _keeper(opponents: Sequence[Point], pitch: Pitch) -> Point | None:
    """The robot that stands before their goal; None where none is seen there."""
    goal = pitch.goal_line, 0.0
    nearest = min(opponents, key=lambda place: math.dist(place, goal), default=None)
    return nearest if nearest is not None and math.dist(nearest, goal) < pitch.goal_width else None


def _ground(
    ball: Point, far: float, keeper: Point | None, opponents: Sequence[Point], pitch: Pitch, parameters: Parameters
) -> Shot:
    """A shot along the ground into the widest lane; from far away a keeper gets across."""
    best, widest = 0.0, -math.inf
    for share in _GROUND_PLACES:
        y = 0.5 * share * pitch.goal_width
        width = lane_width(ball, (pitch.goal_line, y), opponents, parameters.shot_closes)
        if width > widest:
            best, widest = y, width
    chance = max(0.0, min(1.0, (widest - parameters.shot_margin) / parameters.shot_sure))
    near = max(0.0, min(1.0, parameters.ground_range - far))
    near = near if keeper is not None else 1.0
    return Shot(KickMode.GROUND, (pitch.goal_line, best), chance * near * _in_view(ball, pitch))


def _lob(
    ball: Point, far: float, keeper: Point | None, opponents: Sequence[Point], pitch: Pitch, parameters: Parameters
) -> Shot | None:
    """A lob to the part of the goal that is farthest from the robot that keeps it."""
    if far < parameters.lob_nearest:
        return None
    is_off_line = keeper is None or keeper[0] < pitch.goal_line - parameters.off_line
    value = parameters.lob_value if is_off_line else parameters.lob_on_line
    best, least = None, -1.0
    for share in _LOB_PLACES:
        y = 0.5 * share * pitch.goal_width
        rises = parameters.lob_rises / far
        risen = ball[0] + rises * (pitch.goal_line - ball[0]), ball[1] + rises * (y - ball[1])
        if lane_width(ball, risen, opponents) < _LOB_ROOM:
            continue
        beside = abs(keeper[1] - y) if keeper is not None else pitch.goal_width
        chance = value * min(1.0, 0.4 + beside) * _in_view(ball, pitch)
        if chance > least:
            best, least = Shot(KickMode.LOB, (pitch.goal_line, y), chance), chance
    return best


def _in_view(ball: Point, pitch: Pitch) -> float:
    """How much of the goal's width is seen from the ball, 1 from straight ahead."""
    return math.sqrt(max(0.0, math.cos(math.atan2(abs(ball[1]), max(pitch.goal_line - ball[0], 0.01)))))
