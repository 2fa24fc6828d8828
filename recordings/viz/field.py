"""The pitch as a scene: ground, lines as wide as they are painted, marks, goals, boundary, obstacles and zones."""

import math
from collections.abc import Iterator
from itertools import product

from foxglove_schemas_protobuf.CubePrimitive_pb2 import CubePrimitive
from foxglove_schemas_protobuf.CylinderPrimitive_pb2 import CylinderPrimitive
from foxglove_schemas_protobuf.LinePrimitive_pb2 import LinePrimitive
from foxglove_schemas_protobuf.SceneEntity_pb2 import SceneEntity

from recordings.viz.colours import BOUNDARY, GOAL, INK, LINE, MOVABLE, NET, OBSTACLE, PITCH, SURROUND
from recordings.viz.primitives import Triple, cube, cylinder, entity, line, text
from schemas.config.obstacle import Shape
from schemas.config.sections import Pitch
from schemas.config.task import Zone
from schemas.frames import MAP
from schemas.messages.world import ObstacleTruth

LINE_Z = 0.012
"""m above the ground: enough to prevent flickering between layers from 50 m away."""
_GROUND_Z, _SURROUND_Z = 0.0, -0.02
_SLAB = 0.02
_MARK_RADIUS = 0.05
_ARC_STEP = math.radians(6.0)
_BOARD_HEIGHT = 0.15
"""Height of the drawn boundary, in m; a net above it would hide the pitch."""
_THICKNESS = 0.02
_ZONE_OPACITY, _ZONE_TEXT = 0.3, 0.5
"""Opacity of a zone's ground, and height of its name in m."""


def field_entities(pitch: Pitch) -> list[SceneEntity]:
    """The pitch, in the field frame."""
    return [
        *floor_entities(pitch),
        entity("lines", MAP, lines=_lines(pitch), cylinders=_marks(pitch)),
        *(entity(f"goal {end}", MAP, cubes=_goal(pitch, sign)) for end, sign in (("+x", 1), ("-x", -1))),
    ]


def floor_entities(pitch: Pitch) -> list[SceneEntity]:
    """Ground and boundary alone, in the field frame."""
    return [entity("ground", MAP, cubes=_ground(pitch)), entity("boundary", MAP, cubes=_boundary(pitch))]


def zone_entity(zone: Zone) -> SceneEntity:
    """A zone on the ground with its name, in the field frame."""
    x, y = zone.place
    place, colour = (x, y, LINE_Z / 2), INK.faded(_ZONE_OPACITY)
    disc = [cylinder(place, zone.radius, LINE_Z, colour)] if zone.radius is not None else []
    slab = [cube(place, (zone.size[0], zone.size[1], LINE_Z), colour, zone.heading)] if zone.size is not None else []
    label = text((x, y, _ZONE_TEXT / 2), zone.name, _ZONE_TEXT, INK)
    return entity(f"zone {zone.name}", MAP, cylinders=disc, cubes=slab, texts=[label])


def obstacle_entity(name: str, obstacle: ObstacleTruth, frame: str = MAP) -> SceneEntity:
    """An obstacle in `frame`: the field frame, or its own if it can be pushed, which it shows by its colour."""
    colour = OBSTACLE if frame == MAP else MOVABLE
    position, label = (obstacle.x, obstacle.y, obstacle.height / 2), f"obstacle {name}"
    if obstacle.shape is Shape.CYLINDER:
        return entity(label, frame, cylinders=[cylinder(position, obstacle.radius, obstacle.height, colour)])
    size = (obstacle.size_x, obstacle.size_y, obstacle.height)
    return entity(label, frame, cubes=[cube(position, size, colour, obstacle.heading)])


def _ground(pitch: Pitch) -> Iterator[CubePrimitive]:
    around = 2 * pitch.border
    yield cube((0, 0, _SURROUND_Z - _SLAB / 2), (pitch.length + around, pitch.width + around, _SLAB), SURROUND)
    yield cube((0, 0, _GROUND_Z - _SLAB / 2), (pitch.length, pitch.width, _SLAB), PITCH)


def _lines(pitch: Pitch) -> Iterator[LinePrimitive]:
    """Lines along the middle of their paint; a painted line belongs to the area that it bounds."""
    half = pitch.line_width / 2
    x, y = pitch.goal_line - half, pitch.touch_line - half
    yield _line(pitch, [(-x, -y), (x, -y), (x, y), (-x, y)], closed=True)
    yield _line(pitch, [(0.0, -y), (0.0, y)])
    yield _line(pitch, list(_arc(0.0, 0.0, pitch.centre_circle_radius - half, 0.0, math.tau))[:-1], closed=True)
    areas = (
        (pitch.penalty_area_depth, pitch.penalty_area_width),
        (pitch.goal_area_depth, pitch.goal_area_width),
    )
    for sign, (depth, width) in product((1, -1), areas):
        front, side = sign * (pitch.goal_line - depth + half), width / 2 - half
        yield _line(pitch, [(sign * x, -side), (front, -side), (front, side), (sign * x, side)])
    for along, across in product((1, -1), (1, -1)):
        begin = math.atan2(-across, -along) - math.pi / 4
        corner = (along * pitch.goal_line, across * pitch.touch_line)
        yield _line(pitch, list(_arc(*corner, pitch.corner_arc_radius - half, begin, begin + math.pi / 2)))


def _line(pitch: Pitch, points: list[tuple[float, float]], *, closed: bool = False) -> LinePrimitive:
    return line([(x, y, LINE_Z) for x, y in points], pitch.line_width, LINE, closed=closed)


def _arc(x: float, y: float, radius: float, begin: float, end: float) -> Iterator[tuple[float, float]]:
    steps = max(2, round((end - begin) / _ARC_STEP))
    for step in range(steps + 1):
        angle = begin + (end - begin) * step / steps
        yield x + radius * math.cos(angle), y + radius * math.sin(angle)


def _marks(pitch: Pitch) -> Iterator[CylinderPrimitive]:
    for x, y in pitch.restart_spots:
        yield cylinder((x, y, LINE_Z / 2), _MARK_RADIUS, LINE_Z, LINE)


def _goal(pitch: Pitch, sign: int) -> Iterator[CubePrimitive]:
    """Posts and bar behind the goal line, and the net box behind them."""
    post, depth, height = pitch.post, pitch.goal_depth, pitch.goal_height
    front = sign * (pitch.goal_line + post / 2)
    side = (pitch.goal_width + post) / 2
    for y in (-side, side):
        yield cube((front, y, (height + post) / 2), (post, post, height + post), GOAL)
    yield cube((front, 0.0, height + post / 2), (post, pitch.goal_width + 2 * post, post), GOAL)
    back, middle = sign * (pitch.goal_line + depth), sign * (pitch.goal_line + depth / 2)
    net = NET.faded(0.35)
    yield cube((back, 0.0, height / 2), (_THICKNESS, pitch.goal_width, height), net)
    yield cube((middle, 0.0, height), (depth, pitch.goal_width, _THICKNESS), net)
    for y in (-side, side):
        yield cube((middle, y, height / 2), (depth, _THICKNESS, height), net)


def _boundary(pitch: Pitch) -> Iterator[CubePrimitive]:
    height = min(pitch.boundary_height, _BOARD_HEIGHT)
    x, y = pitch.goal_line + pitch.border, pitch.touch_line + pitch.border
    along: Triple = (2 * x, _THICKNESS, height)
    across: Triple = (_THICKNESS, 2 * y, height)
    for sign in (1, -1):
        yield cube((0.0, sign * y, height / 2), along, BOUNDARY)
        yield cube((sign * x, 0.0, height / 2), across, BOUNDARY)
