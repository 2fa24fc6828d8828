"""Draws a heat map of the ball, its path as a thin line, and rings for goals."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap

from recordings.picture.bodies import COLOURS, jumps
from recordings.picture.picture_data import DrawnGoal
from schemas.config.sections import Pitch
from schemas.messages.world import World

_CELL_M = 0.1
_SPREAD_M = 0.4
"""Standard deviation of the spot that one position of the ball leaves on the map."""
_GLOW = ("#ffd34d00", "#ffc93c77", "#ff9d2ebb", "#ff5a36e6", "#fff3d6f5")


def draw_heat(axes: Axes, pitch: Pitch, worlds: Sequence[World]) -> None:
    """Draw the map over the grass, and the path over the map, without steps of a ball placed by hand."""
    half_x, half_y = pitch.goal_line + pitch.border, pitch.touch_line + pitch.border
    way = [(world.ball.x, world.ball.y) for world in worlds]
    cells = [round(2 * half_x / _CELL_M), round(2 * half_y / _CELL_M)]
    x, y = np.array(way).T
    counts, _, _ = np.histogram2d(x, y, cells, [[-half_x, half_x], [-half_y, half_y]])
    offsets = np.arange(-4 * _SPREAD_M, 4 * _SPREAD_M + _CELL_M / 2, _CELL_M)
    kernel = np.exp(-0.5 * (offsets / _SPREAD_M) ** 2)
    for axis in (0, 1):
        counts = np.apply_along_axis(np.convolve, axis, counts, kernel, "same")
    axes.imshow(
        np.sqrt(counts / counts.max()).T,
        origin="lower",
        extent=(-half_x, half_x, -half_y, half_y),
        cmap=LinearSegmentedColormap.from_list("glow", _GLOW),
        interpolation="bilinear",
        zorder=0.5,
    )
    steps = [step for step in pairwise(way) if not jumps(*step)]
    axes.add_collection(LineCollection(steps, colors="#fff7e0", linewidths=0.7, alpha=0.5, zorder=2))


def draw_goals(axes: Axes, goals: Sequence[DrawnGoal]) -> None:
    """Draw a ring in the scoring side's colour at the position of the ball."""
    for goal in goals:
        colour = COLOURS[goal.side] if goal.side is not None else "white"
        for order, (edge, width) in enumerate((("white", 4.5), (colour, 2.5))):
            axes.plot([goal.x], [goal.y], "o", mfc="none", mec=edge, mew=width, ms=15, zorder=5 + order)
