"""A whole picture: the pitch or the floor, zones, obstacles, robots with trails, the ball."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from schemas.messages.setup import Setup
from schemas.messages.world import World
from touchline.drawing.bodies import draw_bodies
from touchline.drawing.pitch import draw_floor, draw_pitch, draw_zones

DPI = 100


def drawn(setup: Setup, worlds: Sequence[World], width: float, dpi: int = DPI) -> tuple[Figure, Axes, float]:
    """The picture of the last of these worlds, `width` inches wide, with trails through those before it.

    Returns figure, axes in m in the field frame, and inches on paper per metre.
    """
    figure = Figure(dpi=dpi)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    draw_ground = draw_pitch if setup.free is None else draw_floor
    draw_ground(axes, setup.pitch)
    draw_zones(axes, setup.task.zones if setup.task is not None else ())
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    scale = width / (right - left)
    figure.set_size_inches(width, scale * (high - low))
    draw_bodies(axes, setup, worlds, scale)
    return figure, axes, scale


def pixels(figure: Figure) -> NDArray[np.uint8]:
    """Red, green and blue of each pixel, shape (height, width, 3)."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()  # type: ignore[no-untyped-call]
    shown: NDArray[np.uint8] = np.asarray(canvas.buffer_rgba())  # type: ignore[no-untyped-call]
    return shown[:, :, :3].copy()
