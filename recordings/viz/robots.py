"""Robots and ball as scenes. They are drawn once in their own frames, and move with these."""

import re
from typing import NamedTuple

from recordings.viz.colours import BALL, INK, MARK, ROBOT, STRANGER, STRANGER_MARK, Colour
from recordings.viz.primitives import Values, arrow, cube, cylinder, entity, sphere, text
from recordings.viz.transforms import BALL as BALL_FRAME
from recordings.viz.transforms import BALL_SHADOW, base
from schemas.host import Setup
from schemas.profile import STANDARD
from schemas.sections import RobotBody
from schemas.side import Side

_PLATE = 0.02
"""Thickness of what lies on a robot or on the ground, m."""
_LABEL_ABOVE, _LABEL_SIZE = 0.35, 0.4
_SHADOW_RADIUS = 0.3
_HOLDER_LARGER = 1.5
_AWAY = 0.25
"""Opacity of a robot that does not take part."""
_JUST_ABOVE_LINES = 0.03


class Player(NamedTuple):
    """One robot, as it is drawn."""

    name: str
    side: Side | None
    """Nothing for a robot that no team has."""
    type: str = STANDARD
    keeper: bool = False
    off_field: str | None = None
    """Why it does not take part."""


def robot_entity(player: Player, setup: Setup) -> Values:
    """A robot: its true hull, a plate on top that is round for cyan and square for magenta, heading, name."""
    body = _body(player, setup)
    opacity = 1.0 if player.off_field is None else _AWAY
    colour = (ROBOT[player.side] if player.side is not None else STRANGER).faded(opacity)
    mark = (MARK[player.side] if player.side is not None else STRANGER_MARK).faded(opacity)
    top = body.height / 2
    cubes = _frame(body, mark)
    cylinders = [cylinder((0.0, 0.0, 0.0), body.radius, body.height, colour)]
    plate = 1.2 * body.radius
    if player.side is Side.MAGENTA:
        cubes.append(cube((0.0, 0.0, top + _PLATE / 2), (plate, plate, _PLATE), mark))
    else:
        cylinders.append(cylinder((0.0, 0.0, top + _PLATE / 2), plate / 2, _PLATE, mark))
    nose = arrow((0.0, 0.0, top + 2 * _PLATE), 1.9 * body.radius, 0.6 * body.radius, mark)
    label = text((0.0, 0.0, top + _LABEL_ABOVE), _label(player), _LABEL_SIZE, INK.faded(opacity))
    facts = {
        "side": player.side.value if player.side is not None else "none",
        "team": setup.teams[player.side].name if player.side is not None else "none",
        "type": player.type,
        "goalkeeper": "yes" if player.keeper else "no",
        "off field": player.off_field or "no",
    }
    return entity(
        player.name, base(player.name), facts=facts, cylinders=cylinders, cubes=cubes, arrows=[nose], texts=[label]
    )


def ball_entities(setup: Setup, holder: Player | None) -> list[Values]:
    """The ball, its place on the ground, and a disc below the robot that holds it."""
    entities = [
        entity("ball", BALL_FRAME, spheres=[sphere((0.0, 0.0, 0.0), setup.ball.radius, BALL)]),
        entity("shadow", BALL_SHADOW, cylinders=[_disc(_JUST_ABOVE_LINES, _SHADOW_RADIUS)]),
    ]
    if holder is not None:
        body = _body(holder, setup)
        below = _JUST_ABOVE_LINES - body.height / 2
        entities.append(entity("holder", base(holder.name), cylinders=[_disc(below, _HOLDER_LARGER * body.radius)]))
    return entities


def _disc(z: float, radius: float) -> Values:
    return cylinder((0.0, 0.0, z), radius, _PLATE, BALL.faded(0.45))


def _body(player: Player, setup: Setup) -> RobotBody:
    model = setup.models.get(player.type)
    return model.body if model is not None else setup.robot


def _frame(body: RobotBody, colour: Colour) -> list[Values]:
    """The box-shaped frame of some bodies, as high as the hull and flush with its front."""
    if not body.frame_width:
        return []
    place = (body.radius - body.frame_depth / 2, 0.0, 0.0)
    return [cube(place, (body.frame_depth, body.frame_width, body.height), colour)]


def _label(player: Player) -> str:
    number = re.search(r"\d+$", player.name)
    words = [number[0] if number and player.side is not None else player.name]
    if player.keeper:
        words.append("GK")
    if player.off_field is not None:
        words.append(f"({player.off_field.replace('_', ' ')})")
    return " ".join(words)
