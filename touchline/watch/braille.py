"""A canvas of braille characters: two dots across and four down in each cell of a terminal, nearly square."""

import math

ACROSS, DOWN = 2, 4
"""Dots in a cell."""
_EMPTY = 0x2800
_BITS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))
"""Unicode's bit of each dot of a braille cell: row by row, left and right."""


class BrailleCanvas:
    """A canvas; dots are counted from the upper left corner, to the right and down."""

    def __init__(self, width: int, height: int) -> None:
        """`width` and `height` in cells."""
        self.width, self.height = width, height
        self.pen: str | None = None
        """Colour of the cells of dots that are drawn from now on; None leaves the colours of cells as they are."""
        self.colours: dict[tuple[int, int], str] = {}
        """Row and column of a cell → its colour, where a pen has drawn."""
        self._cells = [[0] * width for _ in range(height)]

    def dot(self, x: float, y: float) -> None:
        """Draw one dot; dots outside the canvas are ignored."""
        column, row = round(x), round(y)
        if 0 <= column < self.width * ACROSS and 0 <= row < self.height * DOWN:
            self._cells[row // DOWN][column // ACROSS] |= _BITS[row % DOWN][column % ACROSS]
            if self.pen is not None:
                self.colours[row // DOWN, column // ACROSS] = self.pen

    def line(self, x0: float, y0: float, x1: float, y1: float, every: int = 1) -> None:
        """Draw a straight line; of a dotted one, every second, third, … dot."""
        steps = max(1, round(max(abs(x1 - x0), abs(y1 - y0))))
        for step in range(0, steps + 1, every):
            part = step / steps
            self.dot(x0 + part * (x1 - x0), y0 + part * (y1 - y0))

    def circle(self, x: float, y: float, radius: float, every: int = 1) -> None:
        """Draw a circle around a dot."""
        steps = max(8, round(2.0 * math.pi * radius))
        for step in range(0, steps, every):
            angle = 2.0 * math.pi * step / steps
            self.dot(x + radius * math.cos(angle), y + radius * math.sin(angle))

    def rows(self) -> list[str]:
        """The canvas as text, one string a row; a cell without dots is a space."""
        return ["".join(chr(_EMPTY + bits) if bits else " " for bits in row) for row in self._cells]
