"""The value of a pass: will it arrive, and what is the ball worth there. Pure."""

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from robot_agent.sdk.bodies import Body
from robot_agent.soccer.skills.keep_off import inside
from robot_agent.soccer.skills.pass_to import pass_speed
from robot_agent.teams.reference.parameters import Parameters
from schemas.config.sections import Pitch
from schemas.frames import Point, wrap
from schemas.messages.setup import Setup


class Pass(NamedTuple):
    """A pass that could be played, or a ball that is kicked away."""

    receiver: str
    """Empty for a ball that is kicked away."""
    target: Point
    chance: float
    """Of arriving, 0 to 1."""
    value: float

    def strength(self, start: Point, setup: Setup, parameters: Parameters) -> tuple[float, float]:
        """Speed of the kick in m/s, and by how many m it may miss the target."""
        far = math.dist(start, self.target)
        if not self.receiver:
            return setup.kicker.max_ground_speed, parameters.clear_error * far
        return pass_speed(far, setup, parameters.pass_arriving), parameters.pass_error


def chance(start: Point, end: Point, opponents: Sequence[Point], parameters: Parameters) -> float:
    """How surely a ball gets from one point to the other before any opponent is at it, 0 to 1."""
    x0, y0 = start
    dx, dy = end[0] - x0, end[1] - y0
    length = max(math.hypot(dx, dy), 1e-6)
    ux, uy = dx / length, dy / length
    least, reach = parameters.lane_sure, parameters.intercept_reach
    for x, y in opponents:
        dx, dy = x - x0, y - y0
        along = dx * ux + dy * uy
        if along < -0.3 or along > length + 2.0:
            continue
        part = 0.0 if along < 0.0 else length if along > length else along
        room = math.hypot(dx - part * ux, dy - part * uy) - reach
        time = part / parameters.pass_mean_speed - parameters.intercept_reaction
        if time > 0.0:
            room -= time * parameters.intercept_speed
        if room <= 0.0:
            return 0.0
        if room < least:
            least = room
    return least / parameters.lane_sure


def worth(place: Point, opponents: Sequence[Point], pitch: Pitch, parameters: Parameters) -> float:
    """The ball's worth in our hold at a place, 0 to 1: near their goal, central, with room around."""
    to_goal = math.hypot(pitch.goal_line - place[0], place[1])
    room = min([math.dist(place, opponent) for opponent in opponents], default=parameters.worth_room)
    return math.exp(-to_goal / parameters.worth_range) + parameters.worth_free * min(room, parameters.worth_room)


def cost_of_loss(place: Point, pitch: Pitch, parameters: Parameters) -> float:
    """What the ball costs in the opponents' hold at a place."""
    to_goal = math.hypot(place[0] + pitch.goal_line, place[1])
    near = parameters.loss_near * math.exp(-to_goal / parameters.loss_range)
    return parameters.loss * (1.0 - 0.9 * place[0] / pitch.goal_line) + near


def passes(
    ball: Point,
    heading: float,
    mates: Mapping[str, Body],
    opponents: Sequence[Point],
    chosen: tuple[str, Point] | None,
    pitch: Pitch,
    parameters: Parameters,
) -> list[Pass]:
    """All passes within range, into the feet and into the run of each teammate; the best is the largest by value.

    Out of the own third, only those that surely leave it.
    """
    found = []
    for name, body in mates.items():
        for target in targets(ball, body, pitch, parameters):
            far = math.dist(ball, target)
            if not parameters.pass_least < far < parameters.pass_longest:
                continue
            sure = chance(ball, target, opponents, parameters)
            runs = math.dist(_soon(body, parameters), target) / parameters.receiver_runs
            late = parameters.receiver_notices + runs - far / parameters.pass_mean_speed
            sure *= max(0.0, min(1.0, 1.0 - late))
            turn = abs(wrap(math.atan2(target[1] - ball[1], target[0] - ball[0]) - heading))
            sure *= in_time(turn, ball, opponents, parameters)
            gain = sure * (worth(target, opponents, pitch, parameters) + parameters.pass_bonus)
            gain -= (1.0 - sure) * cost_of_loss(target, pitch, parameters) + parameters.turn_cost * turn
            if chosen is not None and chosen[0] == name and math.dist(chosen[1], target) < parameters.chosen_near:
                gain += parameters.chosen_bonus
            found.append(Pass(name, target, sure, gain))
    if ball[0] < parameters.clears_before:
        return [one for one in found if _leads_out(ball, one, opponents, parameters)]
    return found


def _leads_out(ball: Point, one: Pass, opponents: Sequence[Point], parameters: Parameters) -> bool:
    """Whether a pass leaves the own third, and surely gets through its first metres."""
    if one.target[0] < parameters.clears_to:
        return False
    part = min(1.0, parameters.clear_lane / math.dist(ball, one.target))
    first = ball[0] + part * (one.target[0] - ball[0]), ball[1] + part * (one.target[1] - ball[1])
    return chance(ball, first, opponents, parameters) > parameters.clear_sure


def in_time(turn: float, ball: Point, opponents: Sequence[Point], parameters: Parameters) -> float:
    """The chance that a turn by `turn` rad ends before an opponent is at the ball, 0 to 1."""
    nearest = min((math.dist(ball, opponent) for opponent in opponents), default=math.inf)
    comes = max(0.0, nearest - parameters.at_ball) / parameters.comes_speed
    late = turn / parameters.turn_rate - comes
    return max(0.0, min(1.0, 1.0 - late / parameters.wins_duel))


def _soon(mate: Body, parameters: Parameters) -> Point:
    """Where a teammate is when it turns to a pass."""
    notices = parameters.receiver_notices
    return mate.x + notices * mate.vx, mate.y + notices * mate.vy


def targets(ball: Point, mate: Body, pitch: Pitch, parameters: Parameters) -> list[Point]:
    """Where a pass to a teammate may go: to it, ahead of its motion, and behind the defence toward the goal."""
    x, y = _soon(mate, parameters)
    to_goal = math.atan2(-y, pitch.goal_line - 1.0 - x)
    to_ball = math.atan2(ball[1] - y, ball[0] - x)
    lead, aside = parameters.lead, parameters.lead_aside
    wanted = (
        (x, y),
        (x + lead * math.cos(to_goal), y + lead * math.sin(to_goal)),
        (x + lead * math.cos(to_ball + aside), y + lead * math.sin(to_ball + aside)),
        (x + lead * math.cos(to_ball - aside), y + lead * math.sin(to_ball - aside)),
    )
    return [inside(*place, pitch, parameters.pass_inset) for place in wanted]
