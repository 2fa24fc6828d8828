"""Shapes of a scene as `foxglove.*` has them, in m of the frame of their entity; and the entities they belong to."""

import math
from collections.abc import Iterable, Sequence
from typing import Any

from recordings.viz.colours import Colour
from recordings.viz.foxglove import SCENE_ENTITY, SCENE_UPDATE, encode, timestamp
from recordings.viz.protobuf_wire import content

Values = dict[str, Any]
"""Fields of a message."""
Vector3 = tuple[float, float, float]


def pose(position: Vector3, heading: float = 0.0) -> Values:
    """A pose that is turned about z alone."""
    turn = {"z": math.sin(heading / 2), "w": math.cos(heading / 2)}
    return {"position": _vector(position), "orientation": turn}


def cube(position: Vector3, size: Vector3, colour: Colour, heading: float = 0.0) -> Values:
    """A box about `position`."""
    return {"pose": pose(position, heading), "size": _vector(size), "color": colour._asdict()}


def sphere(position: Vector3, radius: float, colour: Colour) -> Values:
    """A ball about `position`."""
    return {"pose": pose(position), "size": _vector((2 * radius,) * 3), "color": colour._asdict()}


def cylinder(position: Vector3, radius: float, height: float, colour: Colour) -> Values:
    """An upright cylinder about `position`."""
    size = _vector((2 * radius, 2 * radius, height))
    return {"pose": pose(position), "size": size, "bottom_scale": 1.0, "top_scale": 1.0, "color": colour._asdict()}


def arrow(position: Vector3, length: float, width: float, colour: Colour) -> Values:
    """An arrow from `position` along x; the last third of it is its head, which is `width` wide."""
    head = length / 3
    shape = {"shaft_length": length - head, "shaft_diameter": width / 2, "head_length": head, "head_diameter": width}
    return {"pose": pose(position), **shape, "color": colour._asdict()}


def line(points: Sequence[Vector3], thickness: float, colour: Colour, *, closed: bool = False) -> Values:
    """A line through all points, and back to the first when it is closed."""
    kind = "LINE_LOOP" if closed else "LINE_STRIP"
    return {
        "type": kind,
        "pose": pose((0.0, 0.0, 0.0)),
        "thickness": thickness,
        "points": [_vector(point) for point in points],
        "color": colour._asdict(),
    }


def text(position: Vector3, string: str, size: float, colour: Colour) -> Values:
    """Words that face whoever looks; `size` is their height."""
    return {"pose": pose(position), "billboard": True, "font_size": size, "color": colour._asdict(), "text": string}


def entity(name: str, frame: str, *, facts: Values | None = None, **shapes: Sequence[Values]) -> Values:
    """Something that moves with its frame; `facts` are shown when somebody clicks on it."""
    pairs = [{"key": key, "value": str(value)} for key, value in (facts or {}).items()]
    return {"frame_id": frame, "id": name, "frame_locked": True, "metadata": pairs, **shapes}


def encode_entity(entity: Values) -> bytes:
    """The bytes of an entity but for its time, to be written again and again."""
    return encode(SCENE_ENTITY, entity)


def scene_update(log_ns: int, entities: Iterable[bytes], deleted: Iterable[str] = ()) -> bytes:
    """A `foxglove.SceneUpdate`: these entities, in place of what they were, and without those that are gone."""
    now = timestamp(log_ns)
    deletions = [{"timestamp": now, "type": "MATCHING_ID", "id": name} for name in deleted]
    time = content(1, now)
    return encode(SCENE_UPDATE, {"deletions": deletions, "entities": [time + encoded for encoded in entities]})


def _vector(position: Vector3) -> Values:
    x, y, z = position
    return {"x": x, "y": y, "z": z}
