"""Robots and ball as scenes. They are drawn once, in their own frames, and move with these."""

import re
from typing import NamedTuple

from foxglove_schemas_protobuf.CubePrimitive_pb2 import CubePrimitive
from foxglove_schemas_protobuf.CylinderPrimitive_pb2 import CylinderPrimitive
from foxglove_schemas_protobuf.SceneEntity_pb2 import SceneEntity

from recordings.viz.colours import BALL, INK, MARK, ROBOT, UNKNOWN_ROBOT, UNKNOWN_ROBOT_MARK, Colour
from recordings.viz.primitives import arrow, cube, cylinder, entity, sphere, text
from recordings.viz.transforms import BALL_SHADOW
from schemas.config.profile import STANDARD
from schemas.config.sections import RobotBody
from schemas.frames import BALL as BALL_FRAME
from schemas.frames import base
from schemas.messages.setup import Setup
from schemas.side import Side

_PLATE = 0.02
"""Thickness of plates on a robot or on the ground, in m."""
_LABEL_ABOVE, _LABEL_SIZE = 0.35, 0.4
_SHADOW_RADIUS = 0.3
_HOLDER_DISC_SCALE = 1.5
_OFF_FIELD_OPACITY = 0.25
"""Opacity of a robot off the field."""
_JUST_ABOVE_LINES = 0.03


class RobotAppearance(NamedTuple):
    """The properties of a robot that determine how it is drawn."""

    name: str
    side: Side | None
    """None for a robot of no team."""
    type: str = STANDARD
    keeper: bool = False
    off_field: str | None = None
    """Why it is off the field; None if it is on it."""


def robot_entity(robot: RobotAppearance, setup: Setup) -> SceneEntity:
    """A robot: hull in true size, a plate on top, round for cyan and square for magenta, heading, and name."""
    body = _body(robot, setup)
    opacity = 1.0 if robot.off_field is None else _OFF_FIELD_OPACITY
    colour = (ROBOT[robot.side] if robot.side is not None else UNKNOWN_ROBOT).faded(opacity)
    mark = (MARK[robot.side] if robot.side is not None else UNKNOWN_ROBOT_MARK).faded(opacity)
    top = body.height / 2
    cubes = _frame(body, mark)
    cylinders = [cylinder((0.0, 0.0, 0.0), body.radius, body.height, colour)]
    plate = 1.2 * body.radius
    if robot.side is Side.MAGENTA:
        cubes.append(cube((0.0, 0.0, top + _PLATE / 2), (plate, plate, _PLATE), mark))
    else:
        cylinders.append(cylinder((0.0, 0.0, top + _PLATE / 2), plate / 2, _PLATE, mark))
    nose = arrow((0.0, 0.0, top + 2 * _PLATE), 1.9 * body.radius, 0.6 * body.radius, mark)
    label = text((0.0, 0.0, top + _LABEL_ABOVE), _label(robot), _LABEL_SIZE, INK.faded(opacity))
    facts = {
        "side": robot.side.value if robot.side is not None else "none",
        "team": setup.teams[robot.side].name if robot.side is not None else "none",
        "type": robot.type,
        "goalkeeper": "yes" if robot.keeper else "no",
        "off field": robot.off_field or "no",
    }
    return entity(
        robot.name, base(robot.name), facts=facts, cylinders=cylinders, cubes=cubes, arrows=[nose], texts=[label]
    )


def ball_entities(setup: Setup, holder: RobotAppearance | None) -> list[SceneEntity]:
    """The ball, its position on the ground, and a disc below the robot that holds it."""
    entities = [
        entity("ball", BALL_FRAME, spheres=[sphere((0.0, 0.0, 0.0), setup.ball.radius, BALL)]),
        entity("shadow", BALL_SHADOW, cylinders=[_disc(_JUST_ABOVE_LINES, _SHADOW_RADIUS)]),
    ]
    if holder is not None:
        body = _body(holder, setup)
        below = _JUST_ABOVE_LINES - body.height / 2
        entities.append(entity("holder", base(holder.name), cylinders=[_disc(below, _HOLDER_DISC_SCALE * body.radius)]))
    return entities


def _disc(z: float, radius: float) -> CylinderPrimitive:
    return cylinder((0.0, 0.0, z), radius, _PLATE, BALL.faded(0.45))


def _body(robot: RobotAppearance, setup: Setup) -> RobotBody:
    model = setup.models.get(robot.type)  # a type that is not the match's is a standard robot
    return model.body if model is not None else setup.robot


def _frame(body: RobotBody, colour: Colour) -> list[CubePrimitive]:
    """The box-shaped frame of some bodies, as high as the hull and flush with its front."""
    if not body.frame_width:
        return []
    place = (body.radius - body.frame_depth / 2, 0.0, 0.0)
    return [cube(place, (body.frame_depth, body.frame_width, body.height), colour)]


def _label(robot: RobotAppearance) -> str:
    number = re.search(r"\d+$", robot.name)
    words = [number[0] if number and robot.side is not None else robot.name]
    if robot.keeper:
        words.append("GK")
    if robot.off_field is not None:
        words.append(f"({robot.off_field.replace('_', ' ')})")
    return " ".join(words)
