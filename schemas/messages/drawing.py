"""A recorder for `Command.debug`: values and shapes are added where a brain computes them."""

import math
from collections.abc import Iterable
from typing import Any

from schemas.messages.debug import Debug, DebugCircle, DebugCorner, DebugLine, DebugPoint, DebugPolygon, DebugText

_DEFAULT = "yellow"


class Drawing:
    """Collects values and shapes of one tick. Points are (x, y) in m in the team frame, as in a sight.

        drawing = Drawing()
        drawing.value("distance_to_ball", distance)
        drawing.line((me.x, me.y), target, "orange")
        drawing.circle(target, 0.5)
        drawing.text((me.x, me.y + 0.6), "wants to pass")
        return Command(answers_tick=sight.tick, drive=drive, debug=drawing.debug())

    A colour is `#rrggbb` or a name of `schemas.messages.debug.COLOURS`.
    """

    def __init__(self) -> None:
        self._values: dict[str, Any] = {}
        self._points: list[DebugPoint] = []
        self._lines: list[DebugLine] = []
        self._circles: list[DebugCircle] = []
        self._polygons: list[DebugPolygon] = []
        self._texts: list[DebugText] = []

    def value(self, name: str, value: float | bool | str) -> None:
        """Show a value by name; numbers become curves. Of two values with one name the later counts.

        JSON has no numbers for NaN and infinity: they become the texts `nan`, `inf` and `-inf`.
        """
        if getattr(value, "shape", None) == ():  # a scalar of numpy
            value = value.item()  # type: ignore[union-attr]
        self._values[name] = str(value) if isinstance(value, float) and not math.isfinite(value) else value

    def point(self, place: tuple[float, float], colour: str = _DEFAULT) -> None:
        """Mark a point."""
        self._points.append(DebugPoint(x=place[0], y=place[1], colour=colour))

    def line(self, start: tuple[float, float], end: tuple[float, float], colour: str = _DEFAULT) -> None:
        """Draw a straight line."""
        self._lines.append(DebugLine(x1=start[0], y1=start[1], x2=end[0], y2=end[1], colour=colour))

    def circle(self, centre: tuple[float, float], radius: float, colour: str = _DEFAULT) -> None:
        """Draw a circle; `radius` in m."""
        self._circles.append(DebugCircle(x=centre[0], y=centre[1], radius=radius, colour=colour))

    def polygon(self, corners: Iterable[tuple[float, float]], colour: str = _DEFAULT) -> None:
        """Draw a closed outline through these corners."""
        self._polygons.append(DebugPolygon(corners=[DebugCorner(x=x, y=y) for x, y in corners], colour=colour))

    def text(self, place: tuple[float, float], text: str, colour: str = _DEFAULT) -> None:
        """Write a text, centred at a point."""
        self._texts.append(DebugText(x=place[0], y=place[1], text=text, colour=colour))

    def debug(self) -> Debug:
        """What was collected so far, for `Command.debug`.

        Raises:
            FaultError: more than the bounds of `schemas.messages.debug` allow, or an invalid value.
        """
        return Debug(
            values=self._values,
            points=self._points,
            lines=self._lines,
            circles=self._circles,
            polygons=self._polygons,
            texts=self._texts,
        )
