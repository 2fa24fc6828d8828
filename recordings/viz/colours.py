"""Colours that people with any colour blindness can distinguish: by lightness, not by hue alone.

Cyan's robots are light, magenta's are dark, and the pitch is in between.
"""

from typing import NamedTuple

from schemas.side import Side


class Colour(NamedTuple):
    """Red, green, blue and opacity, each from 0 to 1; sRGB."""

    r: float
    g: float
    b: float
    a: float = 1.0

    def faded(self, a: float) -> "Colour":
        """The same colour with its opacity multiplied by `a`."""
        return self._replace(a=a * self.a)


def colour_of(code: str) -> Colour:
    """The colour of `#rrggbb`."""
    return Colour(*(int(code[at : at + 2], 16) / 255 for at in (1, 3, 5)))


ROBOT = {Side.CYAN: colour_of("#8fe3f7"), Side.MAGENTA: colour_of("#8a0f5c")}
MARK = {Side.CYAN: colour_of("#0a2f3a"), Side.MAGENTA: colour_of("#ffd9ef")}
"""Marks on a robot: dark on light, light on dark."""
UNKNOWN_ROBOT, UNKNOWN_ROBOT_MARK = colour_of("#9a9a9a"), colour_of("#202020")
"""Colours of a robot of no team."""
BALL = colour_of("#ffb000")
PITCH, SURROUND, LINE = colour_of("#4a9468"), colour_of("#35704e"), colour_of("#ffffff")
GOAL, NET, BOUNDARY, OBSTACLE = colour_of("#ffffff"), colour_of("#e6ece8"), colour_of("#1d3529"), colour_of("#5d6470")
MOVABLE = colour_of("#c9c2b4")
"""Colour of an obstacle that can be pushed; lighter than that of one that stands fast."""
INK = colour_of("#ffffff")
TEAM_TEXT = {Side.CYAN: ROBOT[Side.CYAN], Side.MAGENTA: colour_of("#f59bd0")}
"""A team's name on a dark background."""
