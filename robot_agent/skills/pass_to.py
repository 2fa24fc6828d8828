"""Pass along the ground: to whom, how fast, and the kick itself."""

import math
from collections.abc import Mapping, Sequence

from robot_agent.bodies import DriveLimits, Moving
from robot_agent.skills.kick_at import kick_at
from robot_agent.skills.shoot import lane_width
from schemas.frames import wrap
from schemas.messages.command import Drive, Kick
from schemas.messages.host import Setup

Point = tuple[float, float]

OPEN = 0.5
"""m of free lane that make a pass worth it."""
ARRIVING = 3.5
"""m/s of a pass when it arrives."""
LEAST, LONGEST = 2.0, 9.0
"""m."""
STAYS = 1.0
"""m by which somebody must be farther ahead than the receiver who is chosen already, to be chosen instead."""
EASE = 0.8
"""Share of what is asked of a way to somebody else that is enough for the receiver who is chosen already."""
_TURN_COSTS = 2.0
"""m a radian."""
ERROR = 0.3
"""m beside the receiver."""


def best_receiver(
    ball: Point,
    mates: Mapping[str, Point],
    opponents: Sequence[Point],
    heading: float | None = None,
    chosen: str | None = None,
) -> str | None:
    """The teammate whom a pass reaches and who is farthest ahead, the middle before the wings.

    With a `heading`, turning away from it counts as much as metres do. Who is `chosen` already stays so unless another
    is clearly better: two who are as good would change places with the noise of what is seen. Nobody when each lane is
    closed.
    """
    best, farthest = None, -math.inf
    for name, (x, y) in mates.items():
        ahead = x - 0.3 * abs(y) + (STAYS if name == chosen else 0.0)
        if heading is not None:
            ahead -= _TURN_COSTS * abs(wrap(math.atan2(y - ball[1], x - ball[0]) - heading))
        if ahead > farthest and is_open(ball, (x, y), opponents, EASE if name == chosen else 1.0):
            best, farthest = name, ahead
    return best


def is_open(ball: Point, receiver: Point, opponents: Sequence[Point], ease: float = 1.0) -> bool:
    """Whether a pass is neither too short nor too long, and its lane is free; with `ease` below 1, less is asked."""
    is_in_range = LEAST * ease < math.dist(ball, receiver) < LONGEST / ease
    return is_in_range and lane_width(ball, receiver, opponents) > OPEN * ease


def pass_speed(distance: float, setup: Setup, arriving: float = ARRIVING) -> float:
    """The exit speed in m/s of a ball that still rolls at `arriving` m/s after `distance` m."""
    speed = math.sqrt(arriving * arriving + 2.0 * setup.ball.rolling_deceleration * distance)
    return min(setup.kicker.max_ground_speed, speed)


def pass_to(
    me: Moving, target: Point, setup: Setup, limits: DriveLimits, arriving: float = ARRIVING
) -> tuple[Drive, Kick | None]:
    """Aim at the target, and kick so that the ball arrives there, at `arriving` m/s."""
    return kick_at(me, target, pass_speed(math.dist(target, (me.x, me.y)), setup, arriving), ERROR, limits)
