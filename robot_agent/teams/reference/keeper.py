"""The keeper: where it stands, what it catches, when it comes out. Pure.

A lob passes under the bar at 0.87 m: a hull that stands on the line is in its way, one that stands half a metre before
it is not. So the keeper stands and moves on the line. A ball too near for a lob it comes to meet, until it is kicked.
"""

import math
from collections.abc import Sequence

from robot_agent.sdk.bodies import Ball, Body, DriveLimits
from robot_agent.sdk.skills.braking import travel_time
from robot_agent.sdk.skills.go_to import drive, velocity_to
from robot_agent.sdk.skills.keep_out import Area
from robot_agent.sdk.skills.turn_to import turn_rate
from robot_agent.teams.reference.parameters import Parameters
from schemas.config.rolling import Rolling
from schemas.config.sections import Pitch
from schemas.frames import Point
from schemas.messages.command import Drive


def guard(
    me: Body,
    ball: Ball,
    opponents: Sequence[Point],
    pitch: Pitch,
    reach: float,
    limits: DriveLimits,
    parameters: Parameters,
) -> Drive:
    """Stand where the open angle is halved, nearer to where the holder of the ball points; cross the way of a shot,
    straight aside once it is kicked; come back round the posts."""
    out = parameters.narrows * (parameters.narrows_within - math.hypot(ball.x + pitch.goal_line, ball.y))
    is_kicked = ball.vx < 0.0 and math.hypot(ball.vx, ball.vy) > limits.speed  # no robot drives it that fast
    x = me.x if is_kicked else -pitch.goal_line + parameters.on_line + max(0.0, min(parameters.narrows_most, out))
    crossing = shot_crossing(ball, x, pitch, reach, parameters)
    y = crossing if crossing is not None else _before_shot(ball, opponents, x, pitch, reach, parameters)
    front = -pitch.goal_line + reach
    if abs(y) < abs(me.y) and abs(me.y) > 0.5 * pitch.goal_width - reach:
        vx, vy = velocity_to(me, front + parameters.before_posts, y if me.x > front else me.y, limits)
    else:
        vx, vy = velocity_to(me, x, y, limits)
    if crossing is not None:
        vy = max(-limits.speed, min(limits.speed, parameters.crossing_gain * (y - me.y)))
    facing = math.atan2(ball.y - me.y, max(0.3, ball.x - me.x))
    return drive(me, vx, vy, turn_rate(me, facing, limits), limits)


def _before_shot(
    ball: Ball, opponents: Sequence[Point], x: float, pitch: Pitch, reach: float, parameters: Parameters
) -> float:
    """y on the line at `x` while nobody has shot: where the angle is halved, and nearer to where a kick would go now.

    An opponent that holds the ball kicks along the line from its centre through the ball, and needs time to turn.
    """
    y = halving_place(ball, x, pitch, reach)
    away, holder = min(((math.dist(ball[:2], place), place) for place in opponents), default=(math.inf, ball[:2]))
    ahead = holder[0] - ball[0]
    if away > parameters.holds_within or ahead < parameters.points_least * away:
        return y
    points_at = ball[1] + (ball[1] - holder[1]) / ahead * (ball[0] - x)
    widest = 0.5 * pitch.goal_width
    if abs(points_at) > 2.0 * widest:
        return y
    return y + parameters.points_weight * (max(-widest, min(widest, points_at)) - y)


def halving_place(ball: Ball, x: float, pitch: Pitch, reach: float) -> float:
    """y on the line at `x` that halves the angle between ball and posts, between the posts."""
    half = 0.5 * pitch.goal_width
    back = max(ball.x + pitch.goal_line, 0.1)
    left, right = math.hypot(half - ball.y, back), math.hypot(half + ball.y, back)
    middle = half * (right - left) / (right + left)
    part = (x + pitch.goal_line) / back
    y = middle + part * (ball.y - middle)
    widest = half - 0.6 * reach
    return max(-widest, min(widest, y))


def shot_crossing(ball: Ball, x: float, pitch: Pitch, reach: float, parameters: Parameters) -> float | None:
    """y where a ball on its way into the goal crosses the keeper's line; None when there is no shot."""
    if ball.vx > -parameters.shot_slowest:
        return None
    time = (x - ball.x) / ball.vx
    widest = 0.5 * pitch.goal_width
    y = ball.y + ball.vy * time
    if not 0.0 < time < parameters.shot_horizon or abs(y) > widest + 2.0 * reach:
        return None
    return max(-widest, min(widest, y))


def fetches(
    me: Body,
    ball: Ball,
    opponents: Sequence[Point],
    rolling: Rolling,
    pitch: Pitch,
    limits: DriveLimits,
    parameters: Parameters,
    *,
    has_area: bool,
) -> bool:
    """Whether the keeper comes out for a slow ball near its goal that it reaches clearly first, or that is in its area.

    Args:
        has_area: whether the rules keep all others out of the goal area.
    """
    rests = ball.after(1.0, rolling)
    speed = math.hypot(ball.vx, ball.vy)
    if speed > parameters.comes_out_slow:
        return False
    if has_area and speed < parameters.lies_in_area and Area.goal(pitch).has(-1.0, ball.x, ball.y):
        return True
    if math.hypot(rests.x + pitch.goal_line, rests.y) > parameters.comes_out:
        return False
    mine = travel_time(math.dist(me[:2], rests[:2]), 0.0, limits.speed, limits.acceleration, limits.deceleration)
    theirs = min((math.dist(place, rests[:2]) / parameters.rivals_run for place in opponents), default=math.inf)
    return mine + parameters.first_by < theirs
