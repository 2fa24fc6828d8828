"""The pitch seen from above, x to the right and y up: lines in dots, robots and ball as characters in their colours."""

import math
from collections.abc import Iterable

from rich.style import Style
from rich.text import Text

from schemas.config.sections import Pitch
from schemas.game import RESTARTS, Phase
from schemas.league.robot_numbers import numbers_of
from schemas.messages.debug import Debug
from schemas.messages.game import GameState
from schemas.messages.setup import Setup
from schemas.messages.world import RobotTruth, World
from schemas.side import Side
from touchline.watch.braille import ACROSS, DOWN, BrailleCanvas
from touchline.watch.drawings import draw_shapes
from touchline.watch.scale import MARGIN, Mark, Scale

ARROWS = "→↗↑↖←↙↓↘"
"""Arrows of the headings, counter-clockwise from +x."""
_COMET = 0.4
"""Duration of the ball's drawn path ahead, s."""

LINES = Style(color="green")
BALL = Style(color="bright_yellow", bold=True)
OBSTACLE = Style(color="white", bold=True)
SIDES = {
    Side.CYAN: Style(color="color(16)", bgcolor="color(51)"),
    Side.MAGENTA: Style(color="color(231)", bgcolor="color(163)", bold=True),
}
"""Side → style of its robots: dark on light and light on dark, to be distinct without colour vision."""
AWAY = Style(dim=True)


def rows_for(pitch: Pitch, width: int) -> int:
    """Number of rows of a pitch that is `width` cells wide."""
    dots = (width * ACROSS - 1) / (pitch.length + 2.0 * MARGIN)
    return math.ceil((dots * (pitch.width + 2.0 * MARGIN) + 1) / DOWN)


def field(
    setup: Setup,
    world: World | None,
    state: GameState | None,
    width: int,
    height: int,
    drawings: Iterable[Debug] = (),
) -> list[Text]:
    """The pitch with robots, ball, obstacles and what brains have drawn, in `width` × `height` cells."""
    dots, scale = BrailleCanvas(width, height), Scale.of(setup.pitch, width, height)
    _draw_lines(dots, scale, setup.pitch)
    if state is not None:
        _draw_restart(dots, scale, setup, state)
    marks: list[Mark] = []
    if world is not None:
        x, y = scale.at(world.ball.x, world.ball.y)
        dots.line(x, y, *scale.at(world.ball.x + _COMET * world.ball.vx, world.ball.y + _COMET * world.ball.vy), 2)
        marks = _marks(setup, world)
    marks = [*draw_shapes(dots, scale, drawings), *marks]
    rows = [Text.assemble((row, LINES)) for row in dots.rows()]
    for (row, column), colour in dots.colours.items():
        rows[row].stylize(Style(color=colour), column, column + 1)
    return _overlaid(rows, marks, scale)


def _draw_lines(dots: BrailleCanvas, scale: Scale, pitch: Pitch) -> None:
    far, wide = pitch.goal_line, pitch.touch_line
    _box(dots, scale, -far, far, wide)
    dots.line(*scale.at(0.0, -wide), *scale.at(0.0, wide))
    dots.circle(*scale.at(0.0, 0.0), pitch.centre_circle_radius * scale.dots)
    for end in (-1, 1):
        _box(dots, scale, end * far, end * (far - pitch.penalty_area_depth), pitch.penalty_area_width / 2)
        _box(dots, scale, end * far, end * (far - pitch.goal_area_depth), pitch.goal_area_width / 2)
        _box(dots, scale, end * far, end * (far + pitch.goal_depth), pitch.goal_width / 2)
        dots.dot(*scale.at(end * (far - pitch.penalty_mark), 0.0))


def _box(dots: BrailleCanvas, scale: Scale, x0: float, x1: float, half: float) -> None:
    """Draw a rectangle from x0 to x1, symmetric to the x axis."""
    for y in (-half, half):
        dots.line(*scale.at(x0, y), *scale.at(x1, y))
    for x in (x0, x1):
        dots.line(*scale.at(x, -half), *scale.at(x, half))


def _draw_restart(dots: BrailleCanvas, scale: Scale, setup: Setup, state: GameState) -> None:
    """Draw the distance that opponents keep from the spot, before a restart is taken."""
    if state.phase in RESTARTS and state.spot is not None:
        rules = setup.restarts
        distance = rules.drop_ball_distance if state.phase is Phase.DROP_BALL else rules.opponent_distance
        dots.circle(*scale.at(state.spot.x, state.spot.y), distance * scale.dots, every=3)


def _marks(setup: Setup, world: World) -> list[Mark]:
    """Obstacles, robots, and the ball, which is on top."""
    marks = [Mark(body.x, body.y, "▒▒", OBSTACLE) for body in world.obstacles.values()]
    for side, name, number in numbered(setup):
        robot = world.robots.get(name)
        if robot is not None:
            style = SIDES[side] + AWAY if robot.off_field is not None else SIDES[side]
            marks.append(Mark(robot.x, robot.y, f"{number}{arrow(robot)}", style))
    return [*marks, Mark(world.ball.x, world.ball.y, "●", BALL)]


def numbered(setup: Setup) -> list[tuple[Side, str, int]]:
    """Side, name and number of all robots; the number is that of the name, as on the page."""
    sides = {name: side for side, team in setup.teams.items() for name in team.robots}
    return [(sides[name], name, number) for name, number in numbers_of(sides).items()]


def arrow(robot: RobotTruth) -> str:
    """An arrow for a robot's heading, one of eight directions."""
    return ARROWS[round(robot.heading / (math.pi / 4.0)) % len(ARROWS)]


def _overlaid(rows: list[Text], marks: Iterable[Mark], scale: Scale) -> list[Text]:
    """The rows overlaid with marks; a mark outside the canvas is left out."""
    for mark in marks:
        x, y = scale.at(mark.x, mark.y)
        row = round(y) // DOWN
        column = round(x / ACROSS - 0.5 * (len(mark.text) - 1) - 0.25)
        if 0 <= row < len(rows) and 0 <= column <= len(rows[row]) - len(mark.text):
            left, _, right = rows[row].divide((column, column + len(mark.text)))
            rows[row] = Text.assemble(left, (mark.text, mark.style), right)
    return rows
