"""The message types of a graph: rosbags' store with `touchline_msgs`, their hashes, and the services that it lacks.

The package `touchline_msgs` stands beside this module as colcon builds it. No type of it has an unbounded `uint8[]`:
releases from Lyrical on publish those on keys of their own.
"""

from functools import cache
from pathlib import Path
from typing import Any

from runtime.ros2.topic_type import TopicType
from schemas.errors import TouchlineError

PACKAGES = Path(__file__).parent
"""Folder of the packages of message types."""
_EVENT_INFO = "service_msgs/msg/ServiceEventInfo"
_EMPTY = "uint8 structure_needs_at_least_one_member"
"""What a message without fields has on the wire."""


@cache
def typestore() -> Any:
    """The types of ROS 2 Jazzy and of the packages here; they have the same hashes in later releases.

    Raises:
        TouchlineError: rosbags is not installed.
    """
    try:
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore
    except ModuleNotFoundError:
        raise TouchlineError(
            "messages of ROS 2 require rosbags, which is not installed; pip install 'touchline[ros2]'"
        ) from None
    store = get_typestore(Stores.ROS2_JAZZY)
    constants, fields = store.fielddefs[_EVENT_INFO]
    store.fielddefs[_EVENT_INFO] = (constants, [(name, _without_char(desc)) for name, desc in fields])
    found: dict[str, Any] = {}
    for path in sorted(PACKAGES.glob("*/msg/*.msg")):
        found |= get_types_from_msg(path.read_text("utf-8"), f"{path.parts[-3]}/msg/{path.stem}")
    for path in sorted(PACKAGES.glob("*/srv/*.srv")):
        found |= service_types(f"{path.parts[-3]}/srv/{path.stem}", path.read_text("utf-8"))
    store.register(found)
    return store


def service_types(name: str, text: str) -> dict[str, Any]:
    """The types of a service from its `.srv` text: request, response, event, and the service, which has the hash."""
    from rosbags.interfaces import Nodetype
    from rosbags.typesys import get_types_from_msg

    found: dict[str, Any] = {}
    for part, fields in zip(("Request", "Response"), text.split("---"), strict=True):
        whole = get_types_from_msg(fields if _has_fields(fields) else f"{fields}\n{_EMPTY}\n", f"{name}_{part}")
        ((_, found[f"{name}_{part}"]),) = whole.items()  # rosbags adds `msg` to the name
    request, response = f"{name}_Request", f"{name}_Response"
    info = (Nodetype.NAME, _EVENT_INFO)
    parts = [
        (one, (Nodetype.SEQUENCE, ((Nodetype.NAME, f"{name}_{one.title()}"), 1))) for one in ("request", "response")
    ]
    found[f"{name}_Event"] = ([], [("info", info), *parts])
    names = (("request_message", request), ("response_message", response), ("event_message", f"{name}_Event"))
    found[name] = ([], [(field, (Nodetype.NAME, type_name)) for field, type_name in names])
    return found


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
    found: str = typestore().hash_rihs01(topic_type.message)
    return found
