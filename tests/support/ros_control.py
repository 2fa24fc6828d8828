"""Calls services of a graph by a library that this project did not write: the SDK of ROBOTIS. A process of its own.

`python ros_control.py ENDPOINT` reads calls from its input, JSON in a line each: `[service, type, version, hash,
request]`. It prints each response as a line of JSON. `version` is the folder of the definition, or empty.
"""

import dataclasses
import json
import re
import sys
from pathlib import Path
from typing import Any

PACKAGES = Path(__file__).parents[2] / "runtime" / "ros2"
NEEDED = ("Result", "Resource", "TagsFilter", "Bounds", "EntityCategory", "EntityFilters", "EntityState")
NEEDED += ("SimulationState", "SimulatorFeatures", "SpawnEntity", "SpawnResult")
"""Messages of simulation_interfaces, in an order in which each has its parts before it."""
TEXTS = {
    "builtin_interfaces/msg/Time": "int32 sec\nuint32 nanosec\n",
    "std_msgs/msg/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "geometry_msgs/msg/Vector3": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/msg/Point": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/msg/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n",
    "geometry_msgs/msg/Pose": "Point position\nQuaternion orientation\n",
    "geometry_msgs/msg/PoseStamped": "std_msgs/Header header\nPose pose\n",
    "geometry_msgs/msg/Twist": "Vector3 linear\nVector3 angular\n",
    "geometry_msgs/msg/Accel": "Vector3 linear\nVector3 angular\n",
}
TIMEOUT_S = 100.0


def definitions(service: str, version: str) -> list[str]:
    """Request and response of `package/srv/Name`, with the names of packages."""
    package, kind, name = service.split("/")
    text = (PACKAGES / package / version / kind / f"{name}.srv").read_text()
    parts = re.sub(r"^([A-Z]\w+)", rf"{package}/\1", text, flags=re.MULTILINE).split("---")
    return [part if part.strip() else "uint8 structure_needs_at_least_one_member\n" for part in parts]


def made(store: Any, name: str, given: dict[str, Any]) -> Any:
    """A message of the SDK's store with these fields; the others are zero or empty."""
    from rosbags.interfaces import Nodetype

    def value(kind: Any, field: str) -> Any:
        if kind[0] == Nodetype.NAME:
            return made(store, kind[1], given.get(field, {}))
        if kind[0] == Nodetype.BASE:
            return given.get(field, {"string": "", "bool": False}.get(kind[1][0], 0))
        element, items = kind[1][0], given.get(field, [])
        if element[0] == Nodetype.BASE and kind[0] == Nodetype.ARRAY:
            return items
        return [made(store, element[1], item) if element[0] == Nodetype.NAME else item for item in items]

    return store.types[name](**{field: value(kind, field) for field, kind in store.fielddefs[name][1]})


def without_constants(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """The fields of a message, among which the SDK has constants."""
    return {name: value for name, value in pairs if name.islower() and not name.startswith("_")}


def main(endpoint: str) -> None:
    from zenoh_ros2_sdk import ROS2ServiceClient
    from zenoh_ros2_sdk.session import ZenohSession

    ip, port = endpoint.removeprefix("tcp/").split(":")
    manager = ZenohSession.get_instance(ip, int(port))
    package = PACKAGES / "simulation_interfaces" / "msg"
    own = {f"simulation_interfaces/msg/{name}": (package / f"{name}.msg").read_text() for name in NEEDED}
    for name, text in (TEXTS | own).items():
        manager.register_message_type(text, name)
    clients: dict[tuple[str, str], Any] = {}
    for line in sys.stdin:
        service, kind, version, type_hash, given = json.loads(line)
        if (kind, type_hash) not in clients:
            texts = definitions(kind, version)
            at: dict[str, Any] = {"router_ip": ip, "router_port": int(port), "timeout": TIMEOUT_S}
            clients[kind, type_hash] = ROS2ServiceClient(service, kind, *texts, type_hash=type_hash, **at)
        client = clients[kind, type_hash]
        message = made(manager.store, client.request_store_type, given)
        response = client.call(**{field.name: getattr(message, field.name) for field in dataclasses.fields(message)})
        found = None if response is None else dataclasses.asdict(response, dict_factory=without_constants)
        sys.stdout.write(json.dumps(found, default=lambda array: array.tolist()) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main(sys.argv[1])
