"""Pass along the ground: the receiver, the speed, and the kick itself."""

import math
from collections.abc import Mapping, Sequence

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.soccer.skills.kick_at import kick_at
from robot_agent.soccer.skills.shoot import lane_width
from schemas.config.soccer.kicked import Kicked
from schemas.frames import Point, wrap
from schemas.messages.command import Drive, Kick
from schemas.messages.setup import Setup

OPEN = 0.5
"""m of free lane that make a pass worth it."""
ARRIVING = 3.5
"""m/s of a pass when it arrives."""
LEAST, LONGEST = 2.0, 9.0
"""m."""
STAYS = 1.0
"""m by which another teammate must be farther ahead than the chosen receiver, to replace it."""
EASE = 0.8
"""Factor on the requirements of a pass to the receiver that is chosen already."""
_TURN_COSTS = 2.0
"""m a radian."""
ERROR = 0.3
"""m beside the receiver, at most."""


def best_receiver(
    ball: Point,
    mates: Mapping[str, Point],
    opponents: Sequence[Point],
    heading: float | None = None,
    chosen: str | None = None,
) -> str | None:
    """The teammate farthest ahead that a pass reaches, the middle before the wings; None when every lane is closed.

    With a `heading`, turning away from it costs as metres do. The `chosen` receiver stays unless another is clearly
    better: two equally good ones would alternate with the noise of the sensors.
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
    """Whether a pass is neither too short nor too long, and its lane is free; an `ease` below 1 relaxes all limits."""
    is_in_range = LEAST * ease < math.dist(ball, receiver) < LONGEST / ease
    return is_in_range and lane_width(ball, receiver, opponents) > OPEN * ease


def pass_speed(distance: float, setup: Setup, arriving: float = ARRIVING) -> float:
    """The exit speed in m/s of a ball that still moves at `arriving` m/s after `distance` m."""
    kicked = Kicked.of(setup.ball, setup.kicker)
    return min(setup.kicker.max_ground_speed, kicked.speed_to_arrive(arriving, distance))


def pass_to(
    me: Moving, target: Point, setup: Setup, limits: DriveLimits, arriving: float = ARRIVING
) -> tuple[Drive, Kick | None]:
    """Aim at the target, and kick so that the ball arrives there, at `arriving` m/s."""
    return kick_at(me, target, pass_speed(math.dist(target, (me.x, me.y)), setup, arriving), ERROR, limits)
