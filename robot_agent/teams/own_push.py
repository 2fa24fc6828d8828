"""A push of one's own: the opponent that a robot leans on and drives ahead of itself, let go before it is a foul.

The referee counts the distance of both along the line between their centres (`contact.push_distance`). A robot does not
perceive contacts; it knows its own motion, and where the opponent is.
"""

import math
from collections.abc import Iterable
from typing import NamedTuple

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.skills.go_to import drive
from schemas.frames import Point, rotate
from schemas.messages.command import Drive
from schemas.messages.setup import Setup

TOUCH = 0.1
"""m of air within which the opponent may be touched: noise of localisation and camera."""
APART = 0.2
"""s without contact after which a push is over, for the referee too."""
LETS_GO = 0.5
"""Part of the allowed distance after which the robot lets go: it takes a moment to part."""
PARTS = 0.5
"""m/s away from the opponent meanwhile."""


class OwnPush(NamedTuple):
    """How far this robot has pushed the nearest opponent."""

    way: float = 0.0
    """m; negative while the opponent pushes."""
    apart: float = APART
    """s since they last touched."""
    opponent: Point | None = None
    """m; where the opponent is; None for a robot that touches none."""


def push_after(before: OwnPush, me: Body, opponents: Iterable[Point], dt: float, reach: float) -> OwnPush:
    """The push after `dt` s more; `reach` is the radius of a hull, m."""
    nearest = min(opponents, key=lambda place: math.dist(place, me[:2]), default=None)
    if nearest is None or math.dist(nearest, me[:2]) > 2.0 * reach + TOUCH:
        return OwnPush() if before.apart + dt > APART else OwnPush(before.way, before.apart + dt)
    dx, dy = nearest[0] - me.x, nearest[1] - me.y
    away = max(math.hypot(dx, dy), 1e-6)
    return OwnPush(before.way + (me.vx * dx + me.vy * dy) / away * dt, 0.0, nearest)


def push_limit(setup: Setup) -> float:
    """How far a robot may push an opponent, m; infinite where the rules do not say."""
    return setup.contact.push_distance if setup.fouls.pushing != "off" else math.inf


def let_go_of_opponent(push: OwnPush, me: Body, wanted: Drive, setup: Setup, limits: DriveLimits) -> Drive:
    """The same demand, away from an opponent that has been pushed half of the allowed distance."""
    if push.opponent is None or push.way < LETS_GO * push_limit(setup):
        return wanted
    vx, vy = rotate(wanted.vx, wanted.vy, me.heading)
    dx, dy = push.opponent[0] - me.x, push.opponent[1] - me.y
    away = max(math.hypot(dx, dy), 1e-6)
    excess = (vx * dx + vy * dy) / away + PARTS
    if excess <= 0.0:
        return wanted
    return drive(me, vx - excess * dx / away, vy - excess * dy / away, wanted.omega, limits)
