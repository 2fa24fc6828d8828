"""Bodies that nodes spawn: robots and obstacles, described as in a scene file. Pure.

A resource string is a JSON object: a robot is `{"side": "cyan"}`, with `type`, `agent` and `keeper` if they are not the
usual ones; an obstacle is `{"shape": "cylinder", "radius": 0.3, "height": 0.5}`, or a box with its `size`, and one with
a `mass` can be pushed.
"""

from collections.abc import Container
from itertools import count
from typing import Any

from robot_agent.ros2.simulation.codes import Category, Code, RefusedError
from robot_agent.ros2.simulation.entities import Entity, plane_pose
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.wire.faults import FaultError
from schemas.wire.part_faults import decoded, validated

FORMAT = "touchline"
"""Name of this format."""
_ROBOT, _OBSTACLE = "robot", "obstacle"


def spawn_request(asked: Any, uri: str, text: str, taken: Container[str]) -> tuple[Entity, dict[str, Any]]:
    """The body that a `SpawnEntity` asks for, and the request to the host that adds it.

    Raises:
        RefusedError: it is no such body, or its name is `taken`.
    """
    if asked.entity_namespace:
        raise RefusedError(
            Code.NAMESPACE_INVALID, "the topics of a robot are below its name; leave the namespace empty"
        )
    if uri:
        raise RefusedError(Code.UNSUPPORTED_FORMAT, f"uri is {uri}; describe the body in resource_string, as JSON")
    if not text:
        raise RefusedError(Code.NO_RESOURCE, 'resource_string is empty; a robot is {"side": "cyan"}')
    try:
        body = decoded(dict[str, Any], text)
    except FaultError as error:
        raise RefusedError(Code.RESOURCE_PARSE_ERROR, f"resource_string: {error}") from None
    kind = _ROBOT if "side" in body else _OBSTACLE
    name = _name(asked, kind, taken)
    posed = asked.initial_pose
    x, y, heading = plane_pose(posed.pose, posed.header.frame_id, Code.INVALID_SPAWN_POSE)
    place = {"x": x, "y": y} if kind == _ROBOT else {"place": [x, y]}
    request = {"operation": SceneOperation.ADD, f"{kind}s": [{**body, "name": name, "heading": heading, **place}]}
    try:
        validated(SceneRequest, request)
    except FaultError as error:
        raise RefusedError(Code.RESOURCE_PARSE_ERROR, f"resource_string: {error}") from None
    other = Category.DYNAMIC_OBJECT if "mass" in body else Category.STATIC_OBJECT
    return Entity(name, Category.ROBOT if kind == _ROBOT else other, x, y, 0.0, heading), request


def _name(asked: Any, kind: str, taken: Container[str]) -> str:
    name: str = asked.name
    if asked.allow_renaming and (not name or name in taken):
        return next(other for number in count(1) if (other := f"{name or kind}_{number}") not in taken)
    if name in taken:
        raise RefusedError(Code.NAME_NOT_UNIQUE, f"there is an entity named {name}; set allow_renaming")
    try:
        validated(SceneRequest, {"operation": SceneOperation.REMOVE, "remove": [name]})
    except FaultError:
        raise RefusedError(
            Code.NAME_INVALID, f'name is "{name}"; names have lower-case letters, digits and underscores'
        ) from None
    return name
