"""The chance of a shot, along the ground and over the robots. Pure."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from robot_agent.skills.shoot import best_place, lane_width
from robot_agent.teams.reference.parameters import Parameters
from schemas.config.sections import Pitch
from schemas.messages.command import KickMode

Point = tuple[float, float]

_LOB_PLACES = (-0.7, 0.0, 0.7)
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
    y, width = best_place(ball, opponents, pitch)
    chance = max(0.0, min(1.0, (width - parameters.shot_margin) / parameters.shot_sure))
    ground = Shot(KickMode.GROUND, (pitch.goal_line, y), chance * _in_view(ball, pitch))
    lob = _lob(ball, far, opponents, pitch, parameters)
    return max((ground, lob), key=lambda shot: shot.chance) if lob is not None else ground


def _lob(ball: Point, far: float, opponents: Sequence[Point], pitch: Pitch, parameters: Parameters) -> Shot | None:
    """A lob to the part of the goal that is farthest from the robot that keeps it."""
    if far < parameters.lob_nearest:
        return None
    keeper = min(opponents, key=lambda place: math.dist(place, (pitch.goal_line, 0.0)), default=(0.0, 0.0))
    best, least = None, -1.0
    for share in _LOB_PLACES:
        y = 0.5 * share * pitch.goal_width
        rises = parameters.lob_rises / far
        risen = ball[0] + rises * (pitch.goal_line - ball[0]), ball[1] + rises * (y - ball[1])
        if lane_width(ball, risen, opponents) < _LOB_ROOM:
            continue
        beside = abs(keeper[1] - y) if keeper[0] > pitch.goal_line - 2.0 else pitch.goal_width
        chance = parameters.lob_value * min(1.0, 0.4 + beside) * _in_view(ball, pitch)
        if chance > least:
            best, least = Shot(KickMode.LOB, (pitch.goal_line, y), chance), chance
    return best


def _in_view(ball: Point, pitch: Pitch) -> float:
    """How much of the goal's width is seen from the ball, 1 from straight ahead."""
    return math.sqrt(max(0.0, math.cos(math.atan2(abs(ball[1]), max(pitch.goal_line - ball[0], 0.01)))))
