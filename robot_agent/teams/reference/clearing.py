"""A ball that is kicked away: far ahead out of the own third, where opponents that win it shoot at once. Pure.

It goes along the ground: a lob from the own half that is no pass is a foul.
"""

import math
from collections.abc import Sequence

from robot_agent.soccer.skills.shoot import lane_width
from robot_agent.teams.reference.parameters import Parameters
from robot_agent.teams.reference.passing import Pass, in_time
from schemas.config.sections import Pitch
from schemas.frames import Point, wrap

_WAYS = tuple(math.radians(angle) for angle in range(-60, 61, 15))
"""Directions from the way to their goal line."""


def best_clear(ball: Point, heading: float, opponents: Sequence[Point], pitch: Pitch, parameters: Parameters) -> Pass:
    """The kick to nobody that is likeliest to get far.

    `heading`: of the robot, rad; where it points already is one of the directions.
    """
    ahead = [heading] if math.cos(heading) > parameters.clear_cosine else []
    found = [_clear(ball, way, abs(wrap(way - heading)), opponents, pitch, parameters) for way in (*_WAYS, *ahead)]
    return max(found, key=lambda one: one.value)


def _clear(
    ball: Point, way: float, turn: float, opponents: Sequence[Point], pitch: Pitch, parameters: Parameters
) -> Pass:
    """The kick in one direction, valued by the metres that the ball gains."""
    c, s = math.cos(way), math.sin(way)
    lane = parameters.clear_lane
    width = lane_width(ball, (ball[0] + lane * c, ball[1] + lane * s), opponents)
    sure = max(0.0, min(1.0, width / parameters.clear_room - 0.2)) * in_time(turn, ball, opponents, parameters)
    far = parameters.clear_far
    stays = [  # m until it may be over a touch line, with the error of the kick
        (pitch.touch_line - side * ball[1]) / (side * s + parameters.clear_error)
        for side in (1.0, -1.0)
        if side * s + parameters.clear_error > 1e-6
    ]
    gains = c * max(0.0, min(far, *stays))
    target = ball[0] + far * c, ball[1] + far * s
    return Pass("", target, sure, sure * gains - parameters.clear_turn * turn)
