"""A picture of an episode from above: the floor with its zones, robots with their headings, obstacles, the ball."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from schemas.errors import TouchlineError
from schemas.messages.setup import Setup

_COLOURS = {"cyan": "#19b5c8", "magenta": "#c8198f"}
_SIZE, _DPI = 8.0, 100


def picture_of(setup: Setup, world: dict[str, Any]) -> NDArray[np.uint8]:
    """The picture of a tick, shape (height, width, 3); `world` are the fields of its `schemas.messages.world.World`.

    Raises:
        TouchlineError: matplotlib is not installed.
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
        from matplotlib.patches import Circle, Rectangle
    except ModuleNotFoundError:
        raise TouchlineError("render_mode needs matplotlib; run pip install 'touchline[study]'") from None
    pitch, sides = setup.pitch, setup.sides
    wide, high = pitch.length + 2 * pitch.border, pitch.width + 2 * pitch.border
    figure = Figure((_SIZE, round(_SIZE * high / wide, 2)), dpi=_DPI, facecolor="#275c41")
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0), xlim=(-wide / 2, wide / 2), ylim=(-high / 2, high / 2))
    axes.set_axis_off()
    corner = (-pitch.goal_line, -pitch.touch_line)
    axes.add_patch(Rectangle(corner, pitch.length, pitch.width, facecolor="#2f6f4e", edgecolor="white"))
    for zone in setup.task.zones if setup.task is not None else []:
        x, y = zone.place
        if zone.size is None:
            axes.add_patch(Circle((x, y), zone.radius or 0.0, fill=False, edgecolor="#7fe3fa"))
            continue
        low, angle = (x - zone.size[0] / 2, y - zone.size[1] / 2), math.degrees(zone.heading)
        axes.add_patch(
            Rectangle(low, *zone.size, angle=angle, rotation_point="center", fill=False, edgecolor="#7fe3fa")
        )
    for obstacle in world.get("obstacles", {}).values():
        axes.add_patch(Circle((obstacle["x"], obstacle["y"]), obstacle.get("radius") or 0.3, color="#8a6f4d"))
    for name, robot in world["robots"].items():
        reach, x, y, heading = setup.model_of(name).body.reach, robot["x"], robot["y"], robot["heading"]
        axes.add_patch(Circle((x, y), reach, color=_COLOURS[sides[name].value]))
        axes.plot([x, x + reach * math.cos(heading)], [y, y + reach * math.sin(heading)], color="white")
    if world["ball"] is not None:
        axes.add_patch(Circle((world["ball"]["x"], world["ball"]["y"]), setup.ball.radius, color="#ffb000"))
    canvas: Any = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[:, :, :3].copy()
