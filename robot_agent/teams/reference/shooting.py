"""The chance of a shot, along the ground and over the robots. Pure."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from robot_agent.soccer.skills.shoot import lane_width
from robot_agent.teams.reference.parameters import Parameters
from schemas.config.sections import Pitch
from schemas.frames import Point, wrap
from schemas.messages.command import KickMode

_GROUND_PLACES = (0.0, -0.45, 0.45, -0.78, 0.78)
"""Where a ground shot may aim, as shares of half the goal's width: the ball's edge 0.15 m inside the posts at most."""
_INSIDE_POSTS = 0.83
"""The same share for a shot that is taken where the robot points."""
_LOB_PLACES = (-0.55, 0.0, 0.55)
"""Where a lob may aim, as shares of half the goal's width."""


class Shot(NamedTuple):
    """A shot that could be taken."""

    mode: KickMode
    target: Point
    chance: float
    """Of a goal, 0 to 1."""


def best_shot(
    ball: Point,
    heading: float,
    opponents: Sequence[Point],
    pitch: Pitch,
    parameters: Parameters,
    aimed: Shot | None = None,
) -> Shot | None:
    """The likelier of the best ground shot and the best lob; None out of range.

    Args:
        heading: of the robot, rad.
        aimed: the shot that it aimed at a tick ago.
    """
    far = math.hypot(pitch.goal_line - ball[0], ball[1])
    if far > parameters.shot_range:
        return None
    keeper, opponents = _with_keeper(far, opponents, pitch, parameters)
    ground = _ground(ball, heading, opponents, pitch, parameters, aimed)
    lob = _lob(ball, far, keeper, opponents, pitch, parameters)
    if lob is None:
        return ground
    stays = {aimed.mode: parameters.shot_stays} if aimed is not None else {}
    return max((ground, lob), key=lambda shot: shot.chance + stays.get(shot.mode, 0.0))


def shot_ahead(
    ball: Point, heading: float, opponents: Sequence[Point], pitch: Pitch, parameters: Parameters
) -> Shot | None:
    """The shot along the ground that a kick would be now, without any turn; None if it passes the goal or a post."""
    if math.cos(heading) < parameters.shot_least_cosine:
        return None
    y = ball[1] + math.tan(heading) * (pitch.goal_line - ball[0])
    if abs(y) > 0.5 * _INSIDE_POSTS * pitch.goal_width:
        return None
    target = pitch.goal_line, y
    _, opponents = _with_keeper(math.hypot(pitch.goal_line - ball[0], ball[1]), opponents, pitch, parameters)
    return Shot(KickMode.GROUND, target, _scores(_room(ball, target, opponents, parameters), parameters))


def _scores(room: float, parameters: Parameters) -> float:
    """The chance of a shot with so many m of air beside all opponents."""
    return 1.0 / (1.0 + math.exp(-room / parameters.shot_spread))


def _with_keeper(
    far: float, opponents: Sequence[Point], pitch: Pitch, parameters: Parameters
) -> tuple[Point | None, Sequence[Point]]:
    """The robot that keeps their goal, and all opponents: from afar, a keeper that is not seen is believed there.

    `far`: m from the ball to the goal's middle.
    """
    goal = pitch.goal_line, 0.0
    nearest = min(opponents, key=lambda place: math.dist(place, goal), default=None)
    if nearest is not None and math.dist(nearest, goal) < pitch.goal_width:
        return nearest, opponents
    return (goal, [*opponents, goal]) if far > parameters.keeper_unseen else (None, opponents)


def _ground(
    ball: Point,
    heading: float,
    opponents: Sequence[Point],
    pitch: Pitch,
    parameters: Parameters,
    aimed: Shot | None,
) -> Shot:
    """The shot along the ground with the most room beside all opponents; of equal ones, that with the least turn."""
    best, most, room_there = 0.0, -math.inf, -math.inf
    for share in _GROUND_PLACES:
        y = 0.5 * share * pitch.goal_width
        room = _room(ball, (pitch.goal_line, y), opponents, parameters)
        turn = abs(wrap(math.atan2(y - ball[1], pitch.goal_line - ball[0]) - heading))
        value = room - parameters.shot_turn * turn
        if aimed is not None and aimed.target[1] == y:
            value += parameters.shot_same
        if value > most:
            best, most, room_there = y, value, room
    return Shot(KickMode.GROUND, (pitch.goal_line, best), _scores(room_there, parameters))


def _room(ball: Point, target: Point, opponents: Sequence[Point], parameters: Parameters) -> float:
    """Least m of air between a rolling shot and any opponent, which moves across its path as soon as it can."""
    dx, dy = target[0] - ball[0], target[1] - ball[1]
    length = max(math.hypot(dx, dy), 1e-6)
    ux, uy = dx / length, dy / length
    least = parameters.shot_open
    for x, y in opponents:
        along = (x - ball[0]) * ux + (y - ball[1]) * uy
        if along < -0.2:
            continue
        along = max(0.0, min(length, along))  # a keeper may be seen behind the line
        time = along / parameters.shot_speed
        moves = 0.5 * parameters.shot_crossing * time * time
        beside = math.hypot(x - ball[0] - along * ux, y - ball[1] - along * uy)
        least = min(least, beside - parameters.shot_margin - moves)
    return least


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
        if lane_width(ball, risen, opponents) < parameters.lob_room:
            continue
        beside = abs(keeper[1] - y) if keeper is not None else pitch.goal_width
        chance = value * min(1.0, 0.4 + beside) * _in_view(ball, pitch)
        if chance > least:
            best, least = Shot(KickMode.LOB, (pitch.goal_line, y), chance), chance
    return best


def _in_view(ball: Point, pitch: Pitch) -> float:
    """How much of the goal's width is seen from the ball, 1 from straight ahead."""
    return math.sqrt(max(0.0, math.cos(math.atan2(abs(ball[1]), max(pitch.goal_line - ball[0], 0.01)))))
