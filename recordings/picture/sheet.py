"""The sheet of a picture: panels, a title with teams and score, and a time line with the goals."""

import math
from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from recordings.picture.bodies import COLOURS
from recordings.picture.picture_data import PictureData
from schemas.errors import TouchlineError
from schemas.side import Side
from schemas.soccer.game import Score

_INK = "#10241a"
_FAINT = "#5d6b63"
_PAPER = "#f7f8f4"
_LINE = "#d5dad3"
_WIDTH = 10.0
"""Width of the sheet; all lengths on it are in inches."""
_DOTS_PER_INCH = 160
_HEAD = 0.86
_CAPTION = 0.3
_GAP = 0.08


class Sheet:
    """One sheet: a panel for each time, in two columns if there are several."""

    def __init__(self, data: PictureData, times: Sequence[float]) -> None:
        self._data = data
        self._times = times
        pitch = data.setup.pitch
        several = len(times) > 1
        wide, high = pitch.length + 2 * pitch.border, pitch.width + 2 * pitch.border
        width = _WIDTH / 2 - 1.5 * _GAP if several else _WIDTH
        row = width * high / wide + (_CAPTION + _GAP if several else 0.0)
        self.inches_per_metre = width / wide
        self._height = _HEAD + row * math.ceil(len(times) / 2 if several else 1)
        self._figure = Figure(figsize=(_WIDTH, self._height), dpi=_DOTS_PER_INCH, facecolor=_PAPER)
        self.panels: list[Axes] = []
        for number in range(len(times)):
            left = _GAP + (number % 2) * (width + _GAP) if several else 0.0
            bottom = self._height - _HEAD - (number // 2 + 1) * row + (_GAP if several else 0.0)
            self.panels.append(self._add_axes(left, bottom, width, width * high / wide))

    def title(self, caption: Sequence[str], score: Score | None) -> None:
        """Write teams and score at the top, and a caption above each panel."""
        goals = f"{score.cyan} : {score.magenta}" if score is not None else "–"
        self._text(0.5, 0.28, goals, 19, _INK, "center", bold=True)
        for side, away in ((Side.CYAN, -1), (Side.MAGENTA, 1)):
            self._text(0.5 + 0.055 * away, 0.28, "●", 13, COLOURS[side], "center")
            name = self._data.setup.teams[side].name or side.value
            self._text(0.5 + 0.07 * away, 0.28, name, 15, _INK, "right" if away < 0 else "left")
        if len(caption) == 1:
            self._text(0.5, 0.55, caption[0], 9.5, _FAINT, "center")
        else:
            for panel, messages in zip(self.panels, caption, strict=True):
                panel.set_title(messages, fontsize=9.5, color=_FAINT, pad=4)
        self._time_line()

    def save(self, out: Path) -> None:
        """Write the sheet as PNG or SVG, depending on the suffix of the file.

        Raises:
            TouchlineError: another suffix, or a file that cannot be written.
        """
        if out.suffix not in (".png", ".svg"):
            raise TouchlineError(f"{out}: pictures are written as .png or .svg; give a name with one of these")
        try:
            out.parent.mkdir(parents=True, exist_ok=True)
            self._figure.savefig(out, facecolor=_PAPER)
        except OSError as error:
            raise TouchlineError(f"{out}: {error.strerror}; give a path that can be written") from None

    def _time_line(self) -> None:
        """Draw the match as a line, filled up to the last time shown, with a dot for each time and each goal."""
        line = self._add_axes(0.25 * _WIDTH, self._height - _HEAD + 0.04, 0.5 * _WIDTH, 0.16)
        start, end = self._data.start, max(self._data.end, self._data.start + 1e-9)
        line.set_xlim(start - 0.01 * (end - start), end + 0.01 * (end - start))
        line.set_ylim(-1, 1)
        line.set_axis_off()
        line.plot([start, end], [0, 0], color=_LINE, lw=3, solid_capstyle="round", zorder=1)
        line.plot([start, max(self._times)], [0, 0], color=_FAINT, lw=3, solid_capstyle="round", zorder=2)
        line.plot(self._times, [0] * len(self._times), "o", color=_INK, ms=5, zorder=3)
        for goal in self._data.goals:
            colour = COLOURS[goal.side] if goal.side is not None else _INK
            line.plot([goal.time], [0], "D", color=colour, mec=_PAPER, mew=0.8, ms=6, zorder=4)

    def _add_axes(self, left: float, bottom: float, width: float, height: float) -> Axes:
        whole = self._height
        return self._figure.add_axes((left / _WIDTH, bottom / whole, width / _WIDTH, height / whole))

    def _text(self, x: float, down: float, text: str, size: float, colour: str, align: str, bold: bool = False) -> None:
        """Write text at a fraction `x` of the width, `down` inches below the upper edge."""
        weight = "bold" if bold else "normal"
        place = (x, 1 - down / self._height)
        self._figure.text(*place, text, fontsize=size, fontweight=weight, color=colour, ha=align, va="center")
