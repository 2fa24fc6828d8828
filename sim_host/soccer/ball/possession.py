"""Possession of the ball: the hold condition of each robot, and a fair decision between several robots."""

import math
from collections.abc import Iterable, Sequence

from schemas.config.sections import Dribble
from sim_host.snapshot import BallState, RobotState

TIE_DISTANCE = 0.005
"""m; robots whose distances to the ball differ by less are equally near, and neither gets the ball."""


def can_hold(robot: RobotState, ball: BallState, dribble: Dribble) -> bool:
    """The hold condition, on true states: distance, cone about the kick axis, height (paper, section III B 2)."""
    if ball.z > dribble.max_ball_height:
        return False
    dx, dy = ball.x - robot.x, ball.y - robot.y
    if math.hypot(dx, dy) > dribble.distance:
        return False
    bearing = math.atan2(dy, dx) - robot.heading
    return abs(math.remainder(bearing, 2.0 * math.pi)) <= dribble.cone / 2.0


def claimants(
    claims: Iterable[int], robots: Sequence[RobotState], ball: BallState, dribbles: Sequence[Dribble]
) -> list[tuple[float, int]]:
    """The robots among `claims` that can hold the ball, nearest first: distance from the axis in m, and index."""
    ball_x, ball_y, *_ = ball
    near = [(math.hypot(ball_x - robots[i].x, ball_y - robots[i].y), i) for i in claims]
    return sorted(
        (distance, i)
        for distance, i in near
        if distance <= dribbles[i].distance and can_hold(robots[i], ball, dribbles[i])
    )


def holder(able: Sequence[tuple[float, int]]) -> int | None:
    """The robot that holds the ball: the nearest of the `claimants`, or None when two are equally near.

    The result is the same for both sides and any order of robots. A ball between two equal claims is left to contacts.
    """
    if not able or (len(able) > 1 and able[1][0] - able[0][0] < TIE_DISTANCE):
        return None
    return able[0][1]


def why_not_held(robot: RobotState, ball: BallState, dribble: Dribble) -> str:
    """Why a robot that requests a kick does not hold the ball."""
    if ball.z > dribble.max_ball_height:
        return f"kick: ball in the air, {ball.z:.2f} m high"
    if can_hold(robot, ball, dribble):
        return "kick: ball contested, another robot is equally near"
    return "kick: ball not held"
