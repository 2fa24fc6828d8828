"""Shapes of `foxglove.*` scenes, in m in the frame of their entity, and entities made of them."""

import math
from collections.abc import Iterable, Sequence
from typing import Any

from foxglove_schemas_protobuf.ArrowPrimitive_pb2 import ArrowPrimitive
from foxglove_schemas_protobuf.Color_pb2 import Color
from foxglove_schemas_protobuf.CubePrimitive_pb2 import CubePrimitive
from foxglove_schemas_protobuf.CylinderPrimitive_pb2 import CylinderPrimitive
from foxglove_schemas_protobuf.KeyValuePair_pb2 import KeyValuePair
from foxglove_schemas_protobuf.LinePrimitive_pb2 import LinePrimitive
from foxglove_schemas_protobuf.Point3_pb2 import Point3
from foxglove_schemas_protobuf.Pose_pb2 import Pose
from foxglove_schemas_protobuf.Quaternion_pb2 import Quaternion
from foxglove_schemas_protobuf.SceneEntity_pb2 import SceneEntity
from foxglove_schemas_protobuf.SceneEntityDeletion_pb2 import SceneEntityDeletion
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from foxglove_schemas_protobuf.SpherePrimitive_pb2 import SpherePrimitive
from foxglove_schemas_protobuf.TextPrimitive_pb2 import TextPrimitive
from foxglove_schemas_protobuf.Vector3_pb2 import Vector3

from recordings.viz.colours import Colour
from recordings.viz.foxglove import set_time

Triple = tuple[float, float, float]


def pose(position: Triple, heading: float = 0.0) -> Pose:
    """A pose that is rotated about z only."""
    turn = Quaternion(z=math.sin(heading / 2), w=math.cos(heading / 2))
    return Pose(position=_vector(position), orientation=turn)


def cube(position: Triple, size: Triple, colour: Colour, heading: float = 0.0) -> CubePrimitive:
    """A box about `position`."""
    return CubePrimitive(pose=pose(position, heading), size=_vector(size), color=_color(colour))


def sphere(position: Triple, radius: float, colour: Colour) -> SpherePrimitive:
    """A ball about `position`."""
    return SpherePrimitive(pose=pose(position), size=_vector((2 * radius,) * 3), color=_color(colour))


def cylinder(position: Triple, radius: float, height: float, colour: Colour) -> CylinderPrimitive:
    """An upright cylinder about `position`."""
    size = _vector((2 * radius, 2 * radius, height))
    return CylinderPrimitive(pose=pose(position), size=size, bottom_scale=1.0, top_scale=1.0, color=_color(colour))


def arrow(position: Triple, length: float, width: float, colour: Colour) -> ArrowPrimitive:
    """An arrow from `position` along x; the last third of it is its head, which is `width` wide."""
    head = length / 3
    return ArrowPrimitive(
        pose=pose(position),
        shaft_length=length - head,
        shaft_diameter=width / 2,
        head_length=head,
        head_diameter=width,
        color=_color(colour),
    )


def line(points: Sequence[Triple], thickness: float, colour: Colour, *, closed: bool = False) -> LinePrimitive:
    """A line through all points, and back to the first if it is `closed`."""
    return LinePrimitive(
        type=LinePrimitive.LINE_LOOP if closed else LinePrimitive.LINE_STRIP,
        pose=pose((0.0, 0.0, 0.0)),
        thickness=thickness,
        points=[Point3(x=x, y=y, z=z) for x, y, z in points],
        color=_color(colour),
    )


def text(position: Triple, string: str, size: float, colour: Colour) -> TextPrimitive:
    """Text that faces the viewer; `size` is its height."""
    return TextPrimitive(pose=pose(position), billboard=True, font_size=size, color=_color(colour), text=string)


def entity(name: str, frame: str, facts: dict[str, str] | None = None, **shapes: Any) -> SceneEntity:
    """An entity that moves with its frame; viewers show `facts` when it is selected.

    `shapes` are fields of `SceneEntity`: cubes, cylinders, spheres, arrows, lines and texts, each of its primitive.
    """
    metadata = [KeyValuePair(key=key, value=value) for key, value in (facts or {}).items()]
    return SceneEntity(frame_id=frame, id=name, frame_locked=True, metadata=metadata, **shapes)


def scene_update(entities: Iterable[SceneEntity], deleted: Iterable[str] = ()) -> SceneUpdate:
    """An update that replaces entities and deletes others by name."""
    deletions = [SceneEntityDeletion(type=SceneEntityDeletion.MATCHING_ID, id=name) for name in deleted]
    return SceneUpdate(deletions=deletions, entities=entities)


def encode_scene(update: SceneUpdate, log_ns: int) -> bytes:
    """The bytes of an update with this time in ns."""
    for deletion in update.deletions:
        set_time(deletion.timestamp, log_ns)
    for entity in update.entities:
        set_time(entity.timestamp, log_ns)
    return update.SerializeToString()


def _vector(position: Triple) -> Vector3:
    x, y, z = position
    return Vector3(x=x, y=y, z=z)


def _color(colour: Colour) -> Color:
    return Color(r=colour.r, g=colour.g, b=colour.b, a=colour.a)
