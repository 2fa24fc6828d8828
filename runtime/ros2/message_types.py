"""The message types of a graph: rosbags' store with `touchline_msgs`, their hashes, and the services that it lacks.

The package `touchline_msgs` stands beside this module as colcon builds it. No type of it has an unbounded `uint8[]`:
releases from Lyrical on publish those on keys of their own.
"""

from functools import cache
from pathlib import Path
from typing import Any

from runtime.process.installed import need
from runtime.ros2.topic_type import TopicType

PACKAGES = Path(__file__).parent
"""Folder of the packages of message types."""
_EVENT_INFO = "service_msgs/msg/ServiceEventInfo"
_EMPTY = "uint8 structure_needs_at_least_one_member"
"""What a message without fields has on the wire."""


@cache
def typestore(version: str = "") -> Any:
    """The types of ROS 2 Jazzy and of the packages here; they have the same hashes in later releases.

    With a `version`, services are those of the folder of that name in their package, where it has them.

    Raises:
        TouchlineError: rosbags is not installed.
    """
    need("messages of ROS 2 require rosbags, which is not installed", "ros2", "rosbags")
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    constants, fields = store.fielddefs[_EVENT_INFO]
    store.fielddefs[_EVENT_INFO] = (constants, [(name, _without_char(desc)) for name, desc in fields])
    found: dict[str, Any] = {}
    folders = ("msg", "action", "srv", f"{version}/srv") if version else ("msg", "action", "srv")
    for path in [path for folder in folders for path in sorted(PACKAGES.glob(f"*/{folder}/*"))]:
        package, kind = path.relative_to(PACKAGES).parts[0], path.parent.name
        make = {"msg": get_types_from_msg, "srv": service_types, "action": action_types}[kind]
        found |= make(path.read_text("utf-8"), f"{package}/{kind}/{path.stem}")
    store.register(found)
    return store


def service_types(text: str, name: str) -> dict[str, Any]:
    """The types of a service from its `.srv` text: request, response, event, and the service, which has the hash."""
    return _service(name, *(_fields(part, name) for part in text.split("---")))


def action_types(text: str, name: str) -> dict[str, Any]:
    """The types of an action from its `.action` text: goal, result, feedback, and its services and topic."""
    from rosbags.interfaces import Nodetype

    parts = dict(zip(("Goal", "Result", "Feedback"), (_fields(part, name) for part in text.split("---")), strict=True))
    found: dict[str, Any] = {f"{name}_{part}": fields for part, fields in parts.items()}
    goal_id = ("goal_id", (Nodetype.NAME, "unique_identifier_msgs/msg/UUID"))
    goal, result, feedback = ((part.lower(), (Nodetype.NAME, f"{name}_{part}")) for part in parts)
    stamp = ("stamp", (Nodetype.NAME, "builtin_interfaces/msg/Time"))
    accepted, status = ("accepted", (Nodetype.BASE, ("bool", 0))), ("status", (Nodetype.BASE, ("int8", 0)))
    found |= _service(f"{name}_SendGoal", ([], [goal_id, goal]), ([], [accepted, stamp]))
    found |= _service(f"{name}_GetResult", ([], [goal_id]), ([], [status, result]))
    found[f"{name}_FeedbackMessage"] = ([], [goal_id, feedback])
    return found


def _service(name: str, request: Any, response: Any) -> dict[str, Any]:
    from rosbags.interfaces import Nodetype

    own = {part: (Nodetype.NAME, f"{name}_{part}") for part in ("Request", "Response", "Event")}
    pair = [(part.lower(), (Nodetype.SEQUENCE, (own[part], 1))) for part in ("Request", "Response")]
    return {
        f"{name}_Request": request,
        f"{name}_Response": response,
        f"{name}_Event": ([], [("info", (Nodetype.NAME, _EVENT_INFO)), *pair]),
        name: ([], [(f"{part.lower()}_message", own[part]) for part in own]),
    }


def _fields(text: str, name: str) -> Any:
    """Constants and fields of a part of a service or an action; names without a package are those of its package."""
    from rosbags.typesys import get_types_from_msg

    package = name.partition("/")[0]
    whole = get_types_from_msg(text if _has_fields(text) else f"{text}\n{_EMPTY}\n", f"{package}/msg/Part")
    (fields,) = whole.values()
    return fields


def _without_char(description: Any) -> Any:
    """A field's description with `uint8` for `char`, as ROS hashes it; rosbags 0.11 hashes `char`."""
    if isinstance(description, tuple):
        return tuple("uint8" if part == "char" else _without_char(part) for part in description)
    return description


def _has_fields(text: str) -> bool:
    lines = (line.partition("#")[0].strip() for line in text.splitlines())
    return any(line and "=" not in line for line in lines)


@cache
def hash_of(topic_type: TopicType) -> str:
    """The hash of a type of message or service in keys, `RIHS01_…`.

    Raises:
        TouchlineError: as `typestore`.
    """
    found: str = typestore(topic_type.version).hash_rihs01(topic_type.message)
    return found
