"""The value of a pass: will it arrive, and what is the ball worth there. Pure."""

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from robot_agent.bodies import Body
from robot_agent.skills.keep_off import inside
from robot_agent.teams.reference.parameters import Parameters
from schemas.config.sections import Pitch
from schemas.frames import wrap

Point = tuple[float, float]

_SHARES = (0.25, 0.6, 1.0)
"""Where on its way a carried ball is compared with the opponents, as shares of the way."""


_ROOM = 3.0
"""m around the ball without an opponent, beyond which more room is worth nothing."""
_GOAL_NEAR = 6.0
"""m nearer to their goal, which make the ball worth e times as much."""


class Pass(NamedTuple):
    """A pass that could be played."""

    receiver: str
    target: Point
    chance: float
    """Of arriving, 0 to 1."""
    value: float


def chance(
    start: Point, end: Point, opponents: Sequence[Point], parameters: Parameters, delay: float = 0.0
) -> float:
    """How surely a ball gets from one point to the other before any opponent is at it, 0 to 1.

    The ball leaves after `delay` s, in which opponents come to it and close its lane.
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = max(math.hypot(dx, dy), 1e-6)
    ux, uy = dx / length, dy / length
    least = parameters.lane_sure
    for x, y in opponents:
        along = (x - start[0]) * ux + (y - start[1]) * uy
        if delay > 0.0:
            waits = math.hypot(x - start[0], y - start[1]) - parameters.contest - parameters.presses * delay
            least = min(least, waits)
        if along < -0.3 or along > length + 2.0:
            continue
        part = max(0.0, min(length, along))
        away = math.hypot(x - start[0] - part * ux, y - start[1] - part * uy)
        time = max(0.0, 0.5 * delay + part / parameters.pass_mean_speed - parameters.intercept_reaction)
        least = min(least, away - parameters.intercept_reach - time * parameters.intercept_speed)
    return max(0.0, least / parameters.lane_sure)


def keeps_ball(start: Point, end: Point, opponents: Sequence[Point], parameters: Parameters) -> float:
    """How surely a robot carries the ball from one point to the other before any opponent is at it, 0 to 1."""
    least = parameters.carry_sure
    for share in _SHARES:
        x, y = start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])
        comes = parameters.contest + parameters.presses * share * math.dist(start, end) / parameters.dribble_speed
        for opponent in opponents:
            least = min(least, math.hypot(x - opponent[0], y - opponent[1]) - comes)
    return max(0.0, least / parameters.carry_sure)


def worth(place: Point, opponents: Sequence[Point], pitch: Pitch, came: float = 0.0) -> float:
    """The ball's worth in our hold at a place, 0 to 1: near their goal, central, with room around.

    `came` is how much nearer opponents are by then, m.
    """
    to_goal = math.hypot(pitch.goal_line - place[0], place[1])
    room = min((math.dist(place, opponent) for opponent in opponents), default=math.inf) - came
    room = max(0.0, min(_ROOM, room)) / _ROOM
    return math.exp(-to_goal / _GOAL_NEAR) * (0.4 + 0.6 * room) + 0.1 * room


def cost_of_loss(place: Point, pitch: Pitch, parameters: Parameters) -> float:
    """What the ball costs in the opponents' hold at a place."""
    return parameters.loss * (1.0 - 0.9 * place[0] / pitch.goal_line)


def passes(
    ball: Point,
    heading: float,
    mates: Mapping[str, Body],
    opponents: Sequence[Point],
    chosen: tuple[str, Point] | None,
    pitch: Pitch,
    parameters: Parameters,
) -> list[Pass]:
    """All passes within range, into the feet and into the run of each teammate; the best is the largest by value."""
    found = []
    for name, body in mates.items():
        for target in targets(ball, body, pitch, parameters):
            far = math.dist(ball, target)
            if not parameters.pass_least < far < parameters.pass_longest:
                continue
            turn = abs(wrap(math.atan2(target[1] - ball[1], target[0] - ball[0]) - heading))
            delay = turn / parameters.turns
            sure = chance(ball, target, opponents, parameters, delay)
            late = math.dist(body[:2], target) / parameters.receiver_runs - far / parameters.pass_mean_speed - delay
            sure *= max(0.0, min(1.0, 1.0 - late))
            came = parameters.intercept_speed * (delay + far / parameters.pass_mean_speed)
            gain = sure * (worth(target, opponents, pitch, came) + parameters.pass_bonus)
            gain -= (1.0 - sure) * cost_of_loss(target, pitch, parameters) + parameters.turn_cost * turn
            if chosen is not None and chosen[0] == name and math.dist(chosen[1], target) < parameters.chosen_near:
                gain += parameters.chosen_bonus
            found.append(Pass(name, target, sure, gain))
    return found


def targets(ball: Point, mate: Body, pitch: Pitch, parameters: Parameters) -> list[Point]:
    """Where a pass to a teammate may go: to it, ahead of its motion, and behind the defence toward the goal."""
    x, y = mate.x + 0.4 * mate.vx, mate.y + 0.4 * mate.vy
    to_goal = math.atan2(-y, pitch.goal_line - 1.0 - x)
    to_ball = math.atan2(ball[1] - y, ball[0] - x)
    lead = parameters.lead
    wanted = (
        (x, y),
        (x + lead * math.cos(to_goal), y + lead * math.sin(to_goal)),
        (x + lead * math.cos(to_ball + 1.3), y + lead * math.sin(to_ball + 1.3)),
        (x + lead * math.cos(to_ball - 1.3), y + lead * math.sin(to_ball - 1.3)),
    )
    return [inside(*place, pitch, 0.4) for place in wanted]
