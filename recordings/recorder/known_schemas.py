"""Schemas of messages whose encoding names them: any JSON object, the messages of ROS 2, and those of Foxglove."""

from importlib import import_module
from typing import NamedTuple

from recordings.viz.foxglove import file_set

_FOXGLOVE = "foxglove."


class KnownSchema(NamedTuple):
    """A schema as MCAP has it; without encoding and data, only its name is known."""

    name: str
    encoding: str = ""
    data: bytes = b""


def schema_of(encoding: str, name: str) -> KnownSchema | None:
    """The schema `name` of messages in MCAP's `encoding`; None if they have none."""
    if encoding == "json":
        return KnownSchema(name or "object", "jsonschema", b'{"type":"object"}')
    if not name:
        return None
    definition = {"cdr": _ros2, "protobuf": _protobuf}.get(encoding, lambda _: KnownSchema(""))(name)
    return definition._replace(name=name)


def _ros2(name: str) -> KnownSchema:
    """The definition of a message of ROS 2 Jazzy, if rosbags is installed."""
    try:
        from rosbags.typesys import Stores, get_typestore
    except ModuleNotFoundError:
        return KnownSchema(name)
    store = get_typestore(Stores.ROS2_JAZZY)
    if name not in store.types:
        return KnownSchema(name)
    return KnownSchema(name, "ros2msg", store.generate_msgdef(name, ros_version=2)[0].encode())


def _protobuf(name: str) -> KnownSchema:
    if not name.startswith(_FOXGLOVE):
        return KnownSchema(name)
    try:
        module = import_module(f"foxglove_schemas_protobuf.{name.removeprefix(_FOXGLOVE)}_pb2")
    except ModuleNotFoundError:
        return KnownSchema(name)
    return KnownSchema(name, "protobuf", file_set(module.DESCRIPTOR))
