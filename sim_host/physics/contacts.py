"""Contacts of the last physics step, from the engine's contact points."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from sim_host.physics.body_state import NO_CONTACTS, BallContacts
from sim_host.physics.bullet import pybullet

_TOUCHING = 0.001
"""m; two robots count as touching up to this gap: the solver leaves a smaller one between bodies in contact. They count
so, too, if it has applied a force: it stops bodies that would meet within the step, up to 2 cm apart at its start."""
_HORIZONTAL = 0.5
"""Share of a contact's normal that lies on the ground, at least, if two upright hulls touch with their sides."""


def of_ball(client: int, ball: int, ground: int, robots: Sequence[int], holder: int | None) -> BallContacts:
    """The ball's contacts but for the ground; robots by index; depth in its holder does not count."""
    points = pybullet.getContactPoints(ball, physicsClientId=client)
    if len(points) < 2 and (not points or points[0][2] == ground):
        return NO_CONTACTS
    depth: dict[int, float] = {}
    force: dict[int, float] = {}
    for point in points:
        body = point[2]
        if body != ground:
            depth[body] = -point[8]
            force[body] = force.get(body, 0.0) + point[9]
    forces = {place: force[body] for place, body in enumerate(robots) if body in force}
    if holder is not None:
        depth.pop(robots[holder], None)
    return BallContacts(forces, max(depth.values(), default=0.0))


def direction(client: int, one: int, other: int) -> tuple[float, float] | None:
    """The unit vector on the ground from one hull to another at their contact; None without one."""
    for point in pybullet.getContactPoints(one, other, physicsClientId=client):
        (x, y, _), sign = point[7], -1.0 if point[1] == one else 1.0
        length = math.hypot(x, y)
        if _touches(point) and length > _HORIZONTAL:
            return sign * x / length, sign * y / length
    return None


def of_robots(client: int, robot_of: Mapping[int, int]) -> set[tuple[int, int]]:
    """Pairs of robots that touched, by their indices, the smaller first; `robot_of` maps bodies to indices."""
    found = [
        (robot_of[point[1]], robot_of[point[2]])
        for point in pybullet.getContactPoints(physicsClientId=client)
        if _touches(point) and point[1] in robot_of and point[2] in robot_of
    ]
    return {(min(pair), max(pair)) for pair in found}


def _touches(point: tuple[Any, ...]) -> bool:
    """Whether the bodies of a contact point touched."""
    return bool(point[8] <= _TOUCHING or point[9] > 0.0)
