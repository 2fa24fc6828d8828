"""Shapes of a scene as `foxglove.*` has them, in m of the frame of their entity; and the entities they belong to."""

import math
from collections.abc import Iterable, Sequence
from typing import Any

from recordings.exchange.protobuf.wire import content
from recordings.viz.colours import Colour
from recordings.viz.foxglove import SCENE_ENTITY, SCENE_UPDATE, encode, stamp

Values = dict[str, Any]
"""Fields of a message."""
Place = tuple[float, float, float]


def pose(place: Place, heading: float = 0.0) -> Values:
    """A pose that is turned about z alone."""
    turn = {"z": math.sin(heading / 2), "w": math.cos(heading / 2)}
    return {"position": _vector(place), "orientation": turn}


def cube(place: Place, size: Place, colour: Colour, heading: float = 0.0) -> Values:
    """A box about `place`."""
    return {"pose": pose(place, heading), "size": _vector(size), "color": colour._asdict()}


def sphere(place: Place, radius: float, colour: Colour) -> Values:
    """A ball about `place`."""
    return {"pose": pose(place), "size": _vector((2 * radius,) * 3), "color": colour._asdict()}


def cylinder(place: Place, radius: float, height: float, colour: Colour) -> Values:
    """An upright cylinder about `place`."""
    size = _vector((2 * radius, 2 * radius, height))
    return {"pose": pose(place), "size": size, "bottom_scale": 1.0, "top_scale": 1.0, "color": colour._asdict()}


def arrow(place: Place, length: float, width: float, colour: Colour) -> Values:
    """An arrow from `place` along x; the last third of it is its head, which is `width` wide."""
    head = length / 3
    shape = {"shaft_length": length - head, "shaft_diameter": width / 2, "head_length": head, "head_diameter": width}
    return {"pose": pose(place), **shape, "color": colour._asdict()}


def line(points: Sequence[Place], thickness: float, colour: Colour, *, closed: bool = False) -> Values:
    """A line through all points, and back to the first when it is closed."""
    kind = "LINE_LOOP" if closed else "LINE_STRIP"
    return {
        "type": kind,
        "pose": pose((0.0, 0.0, 0.0)),
        "thickness": thickness,
        "points": [_vector(point) for point in points],
        "color": colour._asdict(),
    }


def text(place: Place, words: str, size: float, colour: Colour) -> Values:
    """Words that face whoever looks; `size` is their height."""
    return {"pose": pose(place), "billboard": True, "font_size": size, "color": colour._asdict(), "text": words}


def entity(name: str, frame: str, *, facts: Values | None = None, **shapes: Sequence[Values]) -> Values:
    """Something that moves with its frame; `facts` are shown when somebody clicks on it."""
    pairs = [{"key": key, "value": str(value)} for key, value in (facts or {}).items()]
    return {"frame_id": frame, "id": name, "frame_locked": True, "metadata": pairs, **shapes}


def body(entity: Values) -> bytes:
    """The bytes of an entity but for its time, to be written again and again."""
    return encode(SCENE_ENTITY, entity)


def scene(log_ns: int, bodies: Iterable[bytes], gone: Iterable[str] = ()) -> bytes:
    """A `foxglove.SceneUpdate`: these entities, in place of what they were, and without those that are gone."""
    now = stamp(log_ns)
    deletions = [{"timestamp": now, "type": "MATCHING_ID", "id": name} for name in gone]
    time = content(1, now)
    return encode(SCENE_UPDATE, {"deletions": deletions, "entities": [time + body for body in bodies]})


def _vector(place: Place) -> Values:
    x, y, z = place
    return {"x": x, "y": y, "z": z}
