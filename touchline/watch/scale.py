"""Where the pitch is on a canvas, and characters placed on it."""

from typing import NamedTuple

from rich.style import Style

from schemas.config.sections import Pitch
from touchline.watch.braille import ACROSS, DOWN

MARGIN = 0.8
"""Margin around the lines, m; includes the goals."""


class Mark(NamedTuple):
    """Characters drawn on the pitch."""

    x: float
    """Centre of the characters, m, field frame."""
    y: float
    text: str
    style: Style


class Scale(NamedTuple):
    """Position of the pitch on a canvas: dots per metre, and the dot of the centre mark."""

    dots: float
    centre_x: float
    centre_y: float

    @classmethod
    def of(cls, pitch: Pitch, width: int, height: int) -> "Scale":
        """The largest pitch that fits into `width` × `height` cells, centred."""
        across, down = width * ACROSS - 1, height * DOWN - 1
        dots = min(across / (pitch.length + 2.0 * MARGIN), down / (pitch.width + 2.0 * MARGIN))
        return cls(dots, 0.5 * across, 0.5 * down)

    def at(self, x: float, y: float) -> tuple[float, float]:
        """The dot of a point; the point in m, field frame."""
        return self.centre_x + x * self.dots, self.centre_y - y * self.dots
