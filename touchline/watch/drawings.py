"""What robots' programs draw for their authors, in the terminal: shapes in their colours, and one robot's values."""

from collections.abc import Iterable, Mapping

from rich.style import Style
from rich.text import Text

from coach_gateway.match.team_names import printable
from schemas.messages.debug import COLOURS, Debug, RobotDebug
from touchline.watch.braille import BrailleCanvas
from touchline.watch.scale import Mark, Scale

_ARM = 2
"""Dots from the centre of a point's mark to its ends."""
_HEAD = Style(bold=True)


def draw_shapes(dots: BrailleCanvas, scale: Scale, drawings: Iterable[Debug]) -> list[Mark]:
    """Draw all shapes but texts on the canvas; returns the texts."""
    texts = []
    for debug in drawings:
        for polygon in debug.polygons:
            dots.pen = _code(polygon.colour)
            corners = [scale.at(corner.x, corner.y) for corner in polygon.corners]
            for start, end in zip(corners, [*corners[1:], corners[0]], strict=True):
                dots.line(*start, *end)
        for circle in debug.circles:
            dots.pen = _code(circle.colour)
            dots.circle(*scale.at(circle.x, circle.y), circle.radius * scale.dots)
        for line in debug.lines:
            dots.pen = _code(line.colour)
            dots.line(*scale.at(line.x1, line.y1), *scale.at(line.x2, line.y2))
        for point in debug.points:
            dots.pen = _code(point.colour)
            x, y = scale.at(point.x, point.y)
            dots.line(x - _ARM, y - _ARM, x + _ARM, y + _ARM)
            dots.line(x - _ARM, y + _ARM, x + _ARM, y - _ARM)
        texts += [Mark(text.x, text.y, printable(text.text), Style(color=_code(text.colour))) for text in debug.texts]
    dots.pen = None
    return texts


def values(robot: str, drawings: Mapping[str, RobotDebug]) -> list[Text]:
    """The values of one robot by name, with a heading; one row that says so where it shows none."""
    shown = drawings[robot].debug.values if robot in drawings else {}
    if not shown:
        return [Text(f"{robot} shows no values")]
    longest = max(map(len, shown))
    rows = [Text(f" {printable(name):{longest}}  {_figure(value)}") for name, value in shown.items()]
    return [Text(f"{robot} shows", style=_HEAD), *rows]


def _code(colour: str) -> str:
    return COLOURS.get(colour, colour)


def _figure(value: float | bool | str) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:.6g}" if isinstance(value, float | int) else printable(value)
