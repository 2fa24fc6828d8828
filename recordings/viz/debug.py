"""What robots' programs draw for their authors, as scenes: one entity for each robot, in the field frame."""

import math
from collections.abc import Iterator

from foxglove_schemas_protobuf.LinePrimitive_pb2 import LinePrimitive
from foxglove_schemas_protobuf.SceneEntity_pb2 import SceneEntity
from google.protobuf.duration_pb2 import Duration

from recordings.viz.colours import Colour, colour_of
from recordings.viz.field import LINE_Z
from recordings.viz.primitives import cylinder, entity, line, text
from schemas.frames import MAP
from schemas.messages.debug import COLOURS, SHOWN_S, Debug, RobotDebug

_Z = 2 * LINE_Z
_THICKNESS = 0.04
_POINT_RADIUS = 0.08
_TEXT_Z, _TEXT_SIZE = 0.5, 0.35
_CIRCLE_STEPS = 48


def debug_entity(drawing: RobotDebug) -> SceneEntity:
    """All shapes of a robot; its values are facts that viewers show when the entity is selected.

    Viewers remove it after `SHOWN_S` of simulated time, unless the robot's next one replaces it.
    """
    debug = drawing.debug
    drawn = entity(
        f"debug {drawing.robot}",
        MAP,
        facts={name: str(value) for name, value in debug.values.items()},
        lines=_lines(debug),
        cylinders=[
            cylinder((point.x, point.y, _Z), _POINT_RADIUS, LINE_Z, _colour(point.colour)) for point in debug.points
        ],
        texts=[text((one.x, one.y, _TEXT_Z), one.text, _TEXT_SIZE, _colour(one.colour)) for one in debug.texts],
    )
    drawn.lifetime.CopyFrom(Duration(nanos=round(SHOWN_S * 1e9)))
    return drawn


def _lines(debug: Debug) -> Iterator[LinePrimitive]:
    for polygon in debug.polygons:
        corners = [(corner.x, corner.y, _Z) for corner in polygon.corners]
        yield line(corners, _THICKNESS, _colour(polygon.colour), closed=True)
    for circle in debug.circles:
        angles = [step * math.tau / _CIRCLE_STEPS for step in range(_CIRCLE_STEPS)]
        around = [
            (circle.x + circle.radius * math.cos(angle), circle.y + circle.radius * math.sin(angle), _Z)
            for angle in angles
        ]
        yield line(around, _THICKNESS, _colour(circle.colour), closed=True)
    for one in debug.lines:
        yield line([(one.x1, one.y1, _Z), (one.x2, one.y2, _Z)], _THICKNESS, _colour(one.colour))


def _colour(name: str) -> Colour:
    return colour_of(COLOURS.get(name, name))
