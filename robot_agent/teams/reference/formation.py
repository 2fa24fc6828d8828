"""The places of the robots that do not play the ball, in attack and defence. Pure."""

import math
from collections.abc import Iterator, Sequence
from functools import cache

from robot_agent.soccer.skills.keep_off import inside
from robot_agent.teams.reference.parameters import Parameters
from robot_agent.teams.reference.passing import chance, worth
from robot_agent.teams.reference.roles import Place, Role
from robot_agent.teams.set_piece import before_own_goal
from schemas.config.sections import Pitch
from schemas.frames import Point

_ANGLES = tuple(math.radians(angle) for angle in (-150, -110, -75, -40, 0, 40, 75, 110, 150))
_DIRECTIONS = tuple((math.cos(angle), math.sin(angle)) for angle in _ANGLES)
"""Where supporters may stand around the ball, from the direction of the attack."""


def places(
    ball: Point,
    *,
    attacks: bool,
    blocks: bool = True,
    opponents: Sequence[Point],
    robots: Sequence[Point],
    pitch: Pitch,
    inset: float,
    parameters: Parameters,
) -> list[Place]:
    """As many places as robots, the most important first; all outside the penalty areas.

    A single robot supports an attack rather than guards.

    Args:
        attacks: whether our side has the ball, or is first at it.
        blocks: whether a robot is needed between the ball and the own goal, besides the one that goes for the ball.
        robots: where the robots are that share the places.
        inset: m between the lines and a robot's centre.
    """
    front = front_of(pitch, inset)
    found = [Place(Role.GUARD, _guard(ball, pitch, front, parameters))] if len(robots) > 1 or not attacks else []
    if blocks and not attacks and ball[0] < parameters.blocks_before:
        x, y = before_own_goal(ball, pitch, parameters.block_distance)
        place = max(-front, x), y
        if all(math.dist(place, other.at) > parameters.defends_apart for other in found):
            found.insert(0, Place(Role.BLOCKER, place))
    if not attacks and ball[0] < parameters.marks_before:
        found += [Place(Role.MARKER, place) for place in _marks(ball, opponents, pitch, front, parameters)]
    found = found[: len(robots)]
    if len(found) == len(robots):
        return found
    supports = _supports(ball, [place.at for place in found], opponents, robots, pitch, front, parameters)
    return found + [Place(Role.SUPPORTER, place) for place in supports]


def front_of(pitch: Pitch, inset: float) -> float:
    """The largest distance from the middle line, m, at which a robot is clear of the penalty areas."""
    return pitch.goal_line - pitch.penalty_area_depth - inset - 0.2


def _guard(ball: Point, pitch: Pitch, front: float, parameters: Parameters) -> Point:
    """Between the own goal and the ball, a share of the distance, and not where others fight for the ball."""
    dx, dy = ball[0] + pitch.goal_line, ball[1]
    away = max(math.hypot(dx, dy), 1e-6)
    share = min(parameters.guard_share, parameters.guard_farthest / away)
    x, y = max(-front, share * dx - pitch.goal_line), share * dy
    room, ahead = parameters.defends_apart, ball[0] - x
    if math.dist((x, y), ball) < room:  # before the penalty area: beside the duel, toward the middle
        y = ball[1] - math.copysign(math.sqrt(room * room - ahead * ahead), ball[1])
    return x, y


def _marks(ball: Point, opponents: Sequence[Point], pitch: Pitch, front: float, parameters: Parameters) -> list[Point]:
    """A place at each opponent without the ball, on the way of a pass to it; the nearest to our goal first."""
    free = [
        place
        for place in opponents
        if math.dist(place, ball) > parameters.marks_beyond and place[0] < parameters.marks_within
    ]
    marks, lane = [], parameters.mark_lane
    goal = 1.0 - lane
    for x, y in sorted(free, key=lambda place: math.dist(place, (-pitch.goal_line, 0.0))):
        dx, dy = lane * (ball[0] - x) + goal * (-pitch.goal_line - x), lane * (ball[1] - y) - goal * y
        away = max(math.hypot(dx, dy), 1e-6)
        place = x + parameters.mark_distance * dx / away, y + parameters.mark_distance * dy / away
        marks.append((max(-front, min(front, place[0])), place[1]))
    return marks[:2]


def _supports(
    ball: Point,
    taken: Sequence[Point],
    opponents: Sequence[Point],
    robots: Sequence[Point],
    pitch: Pitch,
    front: float,
    parameters: Parameters,
) -> list[Point]:
    """The best places for a pass: free lane, room, near their goal, apart from the others, and near a robot already."""
    apart, most_ahead, free_lane = parameters.support_apart, parameters.support_most_ahead, parameters.support_lane
    lane = cache(lambda place: free_lane * chance(ball, place, opponents, parameters))
    open_places = []
    for place in _candidates(ball, robots, pitch, front, parameters):
        if all(math.dist(place, other) >= apart for other in taken):
            way = min([math.dist(place, robot) for robot in robots])
            there = parameters.support_worth * worth(place, opponents, pitch, parameters)
            ahead = parameters.support_ahead * max(-most_ahead, min(most_ahead, place[0] - ball[0]))
            open_places.append((place, there, ahead, parameters.support_sticks * min(way, 6.0)))
    chosen: list[Point] = []
    while len(taken) + len(chosen) < len(robots):
        best, most = ball, -math.inf
        for place, there, ahead, sticks in open_places:
            if free_lane + there + ahead - sticks > most:  # otherwise it is no better with any lane
                value = lane(place) + there + ahead - sticks
                if value > most:
                    best, most = place, value
        chosen.append(best)
        open_places = [one for one in open_places if math.dist(one[0], best) >= apart]
    return chosen


def _candidates(
    ball: Point, robots: Sequence[Point], pitch: Pitch, front: float, parameters: Parameters
) -> Iterator[Point]:
    """Two rings around the ball, and where robots are that could stay."""
    for radius in (parameters.support_near, parameters.support_far):
        for dx, dy in _DIRECTIONS:
            x, y = inside(ball[0] + radius * dx, ball[1] + radius * dy, pitch, parameters.support_inset)
            if -front <= x <= front and math.dist((x, y), ball) > 0.8 * parameters.support_near:
                yield x, y
    for x, y in robots:
        if abs(x) <= front and parameters.support_near < math.dist((x, y), ball) < parameters.pass_longest:
            yield inside(x, y, pitch, parameters.support_inset)
