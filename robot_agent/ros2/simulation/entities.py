"""Entities of the world: robots, ball and obstacles, by their true state in the field frame. Pure."""

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from robot_agent.ros2.simulation.codes import Bounds, Category, Code, RefusedError
from schemas.frames import BALL, MAP
from schemas.messages.world import World

_WORLDS = ("", MAP)
"""Names of the field frame."""
_ROUNDING = 1e-3
"""By which the numbers of a rotation about z may be wrong."""


class Entity(NamedTuple):
    """One body."""

    name: str
    category: Category
    x: float
    y: float
    z: float
    heading: float
    vx: float = 0.0
    vy: float = 0.0
    vz: float = 0.0
    omega: float = 0.0
    radius: float = 0.0
    """m; of the circle around it on the ground."""


def entities_of(world: World, reach: float, ball_radius: float) -> dict[str, Entity]:
    """All bodies by name; `reach` is the radius of robots in m."""
    return {one.name: one for one in _entities(world, reach, ball_radius)}


def named(entities: Mapping[str, Entity], name: str) -> Entity:
    """The body of this name.

    Raises:
        RefusedError: there is none.
    """
    if name not in entities:
        raise RefusedError(Code.NOT_FOUND, f'no entity is named "{name}"; there are {", ".join(entities)}')
    return entities[name]


def chosen(entities: dict[str, Entity], filters: Any) -> list[Entity]:
    """The entities that an `EntityFilters` lets through.

    Raises:
        RefusedError: it filters by what is not supported, or its expression is none.
    """
    if filters.tags.tags:
        raise RefusedError(Code.UNSUPPORTED, "entities have no tags; leave tags empty")
    try:
        pattern = re.compile(filters.filter)
    except (re.error, OverflowError, RecursionError) as error:
        raise RefusedError(Code.FAILED, f'filter is "{filters.filter}", no regular expression: {error}') from None
    categories = {one.category for one in filters.categories}
    found = [one for one in entities.values() if pattern.search(one.name)]
    found = [one for one in found if not categories or one.category in categories]
    return [one for one in found if _is_within(one, filters.bounds)]


def plane_pose(pose: Any, frame: str, code: Code) -> tuple[float, float, float]:
    """x, y and heading of a pose in the field frame.

    Raises:
        RefusedError: with `code`: it is in another frame, not upright, or has numbers that are none.
    """
    if frame not in _WORLDS:
        raise RefusedError(code, f'frame_id is "{frame}"; poses are in "{MAP}", the field frame')
    place, turn = pose.position, pose.orientation
    if not all(math.isfinite(value) for value in (place.x, place.y, place.z)):
        raise RefusedError(code, "a position has a number that is not finite")
    norm = math.hypot(turn.x, turn.y, turn.z, turn.w)
    if not abs(norm - 1.0) <= _ROUNDING or max(abs(turn.x), abs(turn.y)) > _ROUNDING:
        raise RefusedError(code, "the orientation is no rotation about z; bodies stand upright")
    return place.x, place.y, 2.0 * math.atan2(turn.z, turn.w)


def _entities(world: World, reach: float, ball_radius: float) -> Iterator[Entity]:
    for name, robot in world.robots.items():
        pose = robot.x, robot.y, robot.z, robot.heading
        yield Entity(name, Category.ROBOT, *pose, robot.vx, robot.vy, 0.0, robot.omega, reach)
    if (ball := world.ball) is not None:
        place, speed = (ball.x, ball.y, ball.z), (ball.vx, ball.vy, ball.vz)
        yield Entity(BALL, Category.DYNAMIC_OBJECT, *place, 0.0, *speed, 0.0, ball_radius)
    for name, one in world.obstacles.items():
        pose, push = (one.x, one.y, 0.0, one.heading), one.pushed
        if push is None:
            yield Entity(name, Category.STATIC_OBJECT, *pose, radius=one.radius)
        else:
            yield Entity(name, Category.DYNAMIC_OBJECT, *pose, push.vx, push.vy, 0.0, push.omega, one.radius)


def _is_within(one: Entity, bounds: Any) -> bool:
    """Whether the circle around a body overlaps with these bounds on the ground."""
    if bounds.type == Bounds.EMPTY:
        return True
    if bounds.type != Bounds.SPHERE or len(bounds.points) != 2:
        raise RefusedError(Code.UNSUPPORTED, "bounds are a sphere: its centre, and its radius as x of a second point")
    centre, radius = bounds.points[0], bounds.points[1].x
    return bool(math.hypot(one.x - centre.x, one.y - centre.y) <= radius + one.radius)
