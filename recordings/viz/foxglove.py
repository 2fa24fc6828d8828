"""The messages of `foxglove.*` that are written here: what fields they have, their bytes, their descriptors.

Foxglove, Lichtblick and Rerun know these messages by name. One table says what they are; the bytes and the descriptors
beside the channels are made from it, so that they fit each other without any library.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum
from functools import cache
from typing import Any

from recordings.viz.protobuf_wire import (
    DOUBLE,
    FIXED32,
    VARINT,
    content,
    double,
    fixed32,
    tag,
    varint,
    whole,
)

_MESSAGES: dict[str, tuple[str, ...]] = {
    "google.protobuf.Timestamp": ("int64 seconds", "int32 nanos"),
    "google.protobuf.Duration": ("int64 seconds", "int32 nanos"),
    "foxglove.Vector3": ("double x", "double y", "double z"),
    "foxglove.Point3": ("double x", "double y", "double z"),
    "foxglove.Quaternion": ("double x", "double y", "double z", "double w"),
    "foxglove.Pose": ("foxglove.Vector3 position", "foxglove.Quaternion orientation"),
    "foxglove.Color": ("double r", "double g", "double b", "double a"),
    "foxglove.KeyValuePair": ("string key", "string value"),
    "foxglove.FrameTransform": (
        "google.protobuf.Timestamp timestamp",
        "string parent_frame_id",
        "string child_frame_id",
        "foxglove.Vector3 translation",
        "foxglove.Quaternion rotation",
    ),
    "foxglove.FrameTransforms": ("foxglove.FrameTransform* transforms",),
    "foxglove.Log": (
        "google.protobuf.Timestamp timestamp",
        "foxglove.Log.Level level",
        "string message",
        "string name",
        "string file",
        "fixed32 line",
    ),
    "foxglove.ArrowPrimitive": (
        "foxglove.Pose pose",
        "double shaft_length",
        "double shaft_diameter",
        "double head_length",
        "double head_diameter",
        "foxglove.Color color",
    ),
    "foxglove.CubePrimitive": ("foxglove.Pose pose", "foxglove.Vector3 size", "foxglove.Color color"),
    "foxglove.SpherePrimitive": ("foxglove.Pose pose", "foxglove.Vector3 size", "foxglove.Color color"),
    "foxglove.CylinderPrimitive": (
        "foxglove.Pose pose",
        "foxglove.Vector3 size",
        "double bottom_scale",
        "double top_scale",
        "foxglove.Color color",
    ),
    "foxglove.LinePrimitive": (
        "foxglove.LinePrimitive.Type type",
        "foxglove.Pose pose",
        "double thickness",
        "bool scale_invariant",
        "foxglove.Point3* points",
        "foxglove.Color color",
        "foxglove.Color* colors",
        "fixed32* indices",
    ),
    "foxglove.TriangleListPrimitive": (
        "foxglove.Pose pose",
        "foxglove.Point3* points",
        "foxglove.Color color",
        "foxglove.Color* colors",
        "fixed32* indices",
    ),
    "foxglove.TextPrimitive": (
        "foxglove.Pose pose",
        "bool billboard",
        "double font_size",
        "bool scale_invariant",
        "foxglove.Color color",
        "string text",
    ),
    "foxglove.ModelPrimitive": (
        "foxglove.Pose pose",
        "foxglove.Vector3 scale",
        "foxglove.Color color",
        "bool override_color",
        "string url",
        "string media_type",
        "bytes data",
    ),
    "foxglove.SceneEntityDeletion": (
        "google.protobuf.Timestamp timestamp",
        "foxglove.SceneEntityDeletion.Type type",
        "string id",
    ),
    "foxglove.SceneEntity": (
        "google.protobuf.Timestamp timestamp",
        "string frame_id",
        "string id",
        "google.protobuf.Duration lifetime",
        "bool frame_locked",
        "foxglove.KeyValuePair* metadata",
        "foxglove.ArrowPrimitive* arrows",
        "foxglove.CubePrimitive* cubes",
        "foxglove.SpherePrimitive* spheres",
        "foxglove.CylinderPrimitive* cylinders",
        "foxglove.LinePrimitive* lines",
        "foxglove.TriangleListPrimitive* triangles",
        "foxglove.TextPrimitive* texts",
        "foxglove.ModelPrimitive* models",
    ),
    "foxglove.SceneUpdate": ("foxglove.SceneEntityDeletion* deletions", "foxglove.SceneEntity* entities"),
}
"""Message → its fields, numbered from 1 in this order; `*` marks one that repeats."""
_ENUMS: dict[str, tuple[str, ...]] = {
    "foxglove.Log.Level": ("UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"),
    "foxglove.LinePrimitive.Type": ("LINE_STRIP", "LINE_LOOP", "LINE_LIST"),
    "foxglove.SceneEntityDeletion.Type": ("MATCHING_ID", "ALL"),
}
"""Enumeration → its members, numbered from 0."""
FRAME_TRANSFORMS, SCENE_UPDATE, LOG = "foxglove.FrameTransforms", "foxglove.SceneUpdate", "foxglove.Log"
"""The messages that channels carry."""
SCENE_ENTITY = "foxglove.SceneEntity"


class _Type(IntEnum):
    """Numbers of `FieldDescriptorProto.Type`."""

    DOUBLE = 1
    INT64 = 3
    INT32 = 5
    FIXED32 = 7
    BOOL = 8
    STRING = 9
    MESSAGE = 11
    BYTES = 12
    ENUM = 14


_SCALARS = {kind.name.lower(): kind for kind in _Type if kind not in (_Type.MESSAGE, _Type.ENUM)}


@dataclass(frozen=True, slots=True)
class _Field:
    name: str
    number: int
    kind: _Type
    of: str
    """Name of the message or the enumeration."""
    repeats: bool


@cache
def _fields(message: str) -> tuple[_Field, ...]:
    fields = []
    for number, text in enumerate(_MESSAGES[message], 1):
        of, name = text.split()
        repeats, of = of.endswith("*"), of.removesuffix("*")
        kind = _SCALARS.get(of, _Type.ENUM if of in _ENUMS else _Type.MESSAGE)
        fields.append(_Field(name, number, kind, of, repeats))
    return tuple(fields)


def encode(message: str, values: dict[str, Any]) -> bytes:
    """The bytes of a message from its fields; enumerations by the names of their members.

    A message below is a mapping, or the bytes of one. What is left out has protobuf's default: 0, nothing, empty.
    """
    out = []
    for field in _fields(message):
        value = values.get(field.name)
        if value is None:
            continue
        if field.repeats:
            out += [_one(field, each) for each in value]
        elif value or field.kind is _Type.MESSAGE:
            out.append(_one(field, value))
    return b"".join(out)


def _one(field: _Field, value: Any) -> bytes:
    kind, number = field.kind, field.number
    if kind is _Type.MESSAGE:
        return content(number, value if isinstance(value, bytes) else encode(field.of, value))
    if kind is _Type.DOUBLE:
        return tag(number, DOUBLE) + double(value)
    if kind in (_Type.STRING, _Type.BYTES):
        return content(number, value)
    if kind is _Type.FIXED32:
        return tag(number, FIXED32) + fixed32(value)
    return tag(number, VARINT) + varint(_ENUMS[field.of].index(value) if kind is _Type.ENUM else value)


@cache
def descriptors(message: str) -> bytes:
    """The `FileDescriptorSet` of a message and of all below it: a file each, those that others need first."""
    return b"".join(content(1, _file(name)) for name in dict.fromkeys(_below(message)))


def _below(message: str) -> Iterator[str]:
    """What a message is made of, and then itself."""
    for field in _fields(message):
        if field.kind is _Type.MESSAGE:
            yield from _below(field.of)
    yield message


def _file(message: str) -> bytes:
    package, _, name = message.rpartition(".")
    needed = dict.fromkeys(field.of for field in _fields(message) if field.kind is _Type.MESSAGE)
    enums = [full for full in _ENUMS if full.rpartition(".")[0] == message]
    body = content(1, name)
    body += b"".join(content(2, _field_descriptor(field)) for field in _fields(message))
    body += b"".join(content(4, _enum_descriptor(full)) for full in enums)
    out = content(1, _file_name(message)) + content(2, package)
    out += b"".join(content(3, _file_name(other)) for other in needed)
    return out + content(4, body) + content(12, "proto3")


def _file_name(message: str) -> str:
    package, _, name = message.rpartition(".")
    return f"{package.replace('.', '/')}/{name.lower() if package.startswith('google') else name}.proto"


def _field_descriptor(field: _Field) -> bytes:
    out = content(1, field.name) + whole(3, field.number) + whole(4, 3 if field.repeats else 1) + whole(5, field.kind)
    return out + content(6, f".{field.of}") if field.kind in (_Type.MESSAGE, _Type.ENUM) else out


def _enum_descriptor(full: str) -> bytes:
    values = [content(1, name) + whole(2, number) for number, name in enumerate(_ENUMS[full])]
    return content(1, full.rpartition(".")[2]) + b"".join(content(2, value) for value in values)


def timestamp(ns: int) -> bytes:
    """A `google.protobuf.Timestamp`, or a `Duration`, of so many ns."""
    seconds, nanos = divmod(ns, 1_000_000_000)
    out = tag(1, VARINT) + varint(seconds) if seconds else b""
    return out + tag(2, VARINT) + varint(nanos) if nanos else out
