"""Classifies the direction of a kicked ball: at the goal, past it, or elsewhere."""

import math
from enum import Enum, auto

from schemas.config.rolling import GRAVITY, Rolling
from schemas.config.soccer.kicked import Kicked
from schemas.messages.setup import Setup
from schemas.messages.world import BallTruth

NEAR_MISS_M = 1.0
"""m beside a post up to which a kick counts as aimed at the goal, as does one over the bar. Chosen here."""
_FLIES = 0.2
"""m/s upward; a slower ball stays on the ground."""


class Aim(Enum):
    """Direction of one kick."""

    AT_GOAL = auto()
    """Between the posts and below the bar."""
    PAST_GOAL = auto()
    """Over the bar, or up to `NEAR_MISS_M` beside a post."""
    ELSEWHERE = auto()


def aim(ball: BallTruth, attack: int, setup: Setup) -> Aim:
    """Where the ball crosses the attacked goal line (`attack` is the sign of its x) if it rolls or flies freely.

    The ball moves in a straight line and is slowed as one that was kicked along the ground, or as a rolling one where
    it flies first: a ball that stops before the line is aimed elsewhere. A flying ball follows a parabola without drag
    until it lands; after that it is below the bar.
    """
    pitch = setup.pitch
    ahead = pitch.goal_line - attack * ball.x
    closing = attack * ball.vx
    if ahead <= 0 or closing <= 0:
        return Aim.ELSEWHERE
    time = ahead / closing
    beside = abs(ball.y + ball.vy * time) - pitch.goal_width / 2
    if beside > NEAR_MISS_M:  # first: for a ball along the line the distance to it exceeds any number
        return Aim.ELSEWHERE
    speed = math.hypot(ball.vx, ball.vy)
    slowed = Rolling.of(setup.ball) if ball.vz > _FLIES else Kicked.of(setup.ball, setup.kicker)
    if slowed.speed_to_arrive(0.0, speed * time) > speed:
        return Aim.ELSEWHERE
    height = ball.z + ball.vz * time - GRAVITY / 2 * time * time
    lands = (ball.vz + math.sqrt(ball.vz**2 + 2 * GRAVITY * max(0.0, ball.z - setup.ball.radius))) / GRAVITY
    over = time < lands and height > pitch.goal_height
    return Aim.PAST_GOAL if beside > 0 or over else Aim.AT_GOAL
