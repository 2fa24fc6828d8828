"""Avoid obstacles: take the free direction nearest to the wanted one."""

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.sdk.skills.go_to import drive, velocity_to
from robot_agent.sdk.skills.turn_to import turn_rate
from schemas.frames import wrap
from schemas.messages.command import Drive

LOOK_AHEAD = 2.0
"""m; a circle whose edge is farther away is not in the way yet."""
_MARGIN = 0.02
"""rad; how far beside a blocked arc a direction counts as free."""
_MOMENTUM = 0.3
"""Cost of turning away from the present direction of motion, against turning away from the wanted one."""
_BEND = 0.6
"""Part of the acceleration that following a circle's edge may take."""


class Circle(NamedTuple):
    """A place that the robot's centre shall not enter: m."""

    x: float
    y: float
    radius: float


def circles(points: Iterable[tuple[float, float]], radius: float) -> list[Circle]:
    """The same circle around each point."""
    return [Circle(x, y, radius) for x, y in points]


def circles_near(me: Moving, points: Iterable[tuple[float, float]], radius: float) -> list[Circle]:
    """The same circle around each point, without those that are too far away to be in the way yet."""
    near = LOOK_AHEAD + 3.0 * radius  # no circle beyond 2 radii is entered, with any rounding
    x0, y0 = me.x, me.y
    return [Circle(x, y, radius) for x, y in points if -near < x - x0 < near and -near < y - y0 < near]


def go_around(me: Moving, x: float, y: float, heading: float, blocked: Sequence[Circle], limits: DriveLimits) -> Drive:
    """Drive to (x, y) around the circles and stop there."""
    vx, vy = velocity_to(me, x, y, limits)
    vx, vy = steer(me, vx, vy, math.hypot(x - me.x, y - me.y), blocked)
    return drive(me, vx, vy, turn_rate(me, heading, limits), limits)


def bend_speed(away: float, radius: float, limits: DriveLimits) -> float:
    """The highest speed, m/s, of a robot `away` m from a circle's centre that is to follow its edge.

    At the edge, part of the acceleration has to bend its path; farther away the robot can still brake to that speed.
    """
    room = max(0.0, away - radius)
    return math.sqrt(limits.acceleration * (_BEND * radius + room))


def steer(me: Moving, vx: float, vy: float, distance: float, blocked: Sequence[Circle]) -> tuple[float, float]:
    """The velocity turned into the nearest direction that is free for `distance` m; the speed stays."""
    speed = math.hypot(vx, vy)
    if speed < 1e-6:
        return vx, vy
    wanted = math.atan2(vy, vx)
    direction = free_direction(me, wanted, distance, blocked)
    if direction == wanted:
        return vx, vy
    return speed * math.cos(direction), speed * math.sin(direction)


def free_direction(me: Moving, wanted: float, distance: float, blocked: Sequence[Circle]) -> float:
    """The direction nearest to `wanted` that enters no circle; `wanted` itself when every direction is blocked.

    A robot inside a circle may leave it: at its edge sideways, the more outward the deeper it is inside.
    """
    if not _enters(me, wanted, distance, blocked):
        return wanted
    arcs = _arcs(me, distance, blocked)
    moving = math.atan2(me.vy, me.vx) if math.hypot(me.vx, me.vy) > 0.3 else wanted
    best, least = wanted, math.inf
    for middle, half in arcs:
        for edge in (middle + half + _MARGIN, middle - half - _MARGIN):
            turn = abs(wrap(edge - wanted)) + _MOMENTUM * abs(wrap(edge - moving))
            if turn < least and all(abs(wrap(edge - other)) >= width for other, width in arcs):
                best, least = edge, turn
    return best


def _enters(me: Moving, direction: float, distance: float, blocked: Iterable[Circle]) -> bool:
    """Whether the next part of a straight path leads into one of the circles, or deeper into it."""
    c, s = math.cos(direction), math.sin(direction)
    for x, y, radius in blocked:
        dx, dy = x - me.x, y - me.y
        along = dx * c + dy * s
        if along > 0.0:
            along = min(along, distance, LOOK_AHEAD + radius)
            if math.hypot(dx - along * c, dy - along * s) < radius:
                return True
    return False


def _arcs(me: Moving, distance: float, blocked: Sequence[Circle]) -> list[tuple[float, float]]:
    """Middle and half width in rad of each range of directions that leads into a circle."""
    arcs = []
    for x, y, radius in blocked:
        dx, dy = x - me.x, y - me.y
        away = math.hypot(dx, dy)
        if away - radius > min(distance, LOOK_AHEAD):
            continue
        half = math.asin(radius / away) if away > radius else 0.5 * math.pi + min(1.0, 2.0 * (1.0 - away / radius))
        arcs.append((math.atan2(dy, dx), half))
    return arcs


def is_in_the_way(me: Moving, x: float, y: float, circle: Circle) -> bool:
    """Whether the straight path to (x, y) leads into a circle."""
    return _enters(me, math.atan2(y - me.y, x - me.x), math.hypot(x - me.x, y - me.y), (circle,))
