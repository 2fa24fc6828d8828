"""Draws the pitch of soccer, or the floor of a free game, and zones, in m in the field frame."""

import math
from collections.abc import Iterable

from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, Rectangle

from schemas.config.sections import Pitch
from schemas.config.task import Zone

_GRASS = "#2f6f4e"
_MOWN = "#33775a"
_SURROUND = "#275c41"
_LINE = "#eef4ef"
_NET = "#d7e0da"
_STRIPES = 11
_ZONE = {"facecolor": "#7fe3fa26", "edgecolor": "#c7d8cf", "lw": 1.3, "zorder": 1}


def draw_pitch(axes: Axes, pitch: Pitch) -> None:
    """Draw the pitch below everything else, x to the right and y up, and set the limits of the axes to it."""
    draw_floor(axes, pitch)
    axes.plot([0, 0], [-pitch.touch_line, pitch.touch_line], color=_LINE, lw=1.3, zorder=1)
    _arc(axes, 0, 0, pitch.centre_circle_radius, 0, 360)
    for x, y in pitch.restart_spots:
        axes.plot([x], [y], "o", color=_LINE, ms=1.8, zorder=1)
    for sign in (-1, 1):
        _end(axes, pitch, sign)


def draw_floor(axes: Axes, pitch: Pitch) -> None:
    """Draw the floor of a free game, and set the limits of the axes to it."""
    _ground(axes, pitch)
    margin_x = pitch.border + pitch.goal_depth * 0.2
    axes.set_xlim(-pitch.goal_line - margin_x, pitch.goal_line + margin_x)
    axes.set_ylim(-pitch.touch_line - pitch.border, pitch.touch_line + pitch.border)
    axes.set_aspect("equal")
    axes.set_axis_off()
    _box(axes, -pitch.goal_line, -pitch.touch_line, pitch.length, pitch.width)


def draw_zones(axes: Axes, zones: Iterable[Zone]) -> None:
    """Draw zones with their names."""
    for zone in zones:
        x, y = zone.place
        if zone.size is None:
            axes.add_patch(Circle((x, y), zone.radius or 0.0, **_ZONE))
        else:
            wide, high = zone.size
            angle, corner = math.degrees(zone.heading), (x - wide / 2, y - high / 2)
            axes.add_patch(Rectangle(corner, wide, high, angle=angle, rotation_point="center", **_ZONE))
        axes.text(x, y, zone.name, color=_LINE, fontsize=9, ha="center", va="center", zorder=1.1)


def _ground(axes: Axes, pitch: Pitch) -> None:
    wide, high = pitch.length + 4 * pitch.border, pitch.width + 4 * pitch.border
    axes.add_patch(Rectangle((-wide / 2, -high / 2), wide, high, color=_SURROUND, lw=0, zorder=0))
    stripe = pitch.length / _STRIPES
    for number in range(_STRIPES):
        axes.add_patch(
            Rectangle(
                (-pitch.goal_line + number * stripe, -pitch.touch_line),
                stripe,
                pitch.width,
                color=_GRASS if number % 2 else _MOWN,
                lw=0,
                zorder=0.1,
            )
        )


def _end(axes: Axes, pitch: Pitch, sign: int) -> None:
    """Draw one end of the pitch: areas, corner arcs, goal."""
    line = sign * pitch.goal_line
    for depth, width in (
        (pitch.penalty_area_depth, pitch.penalty_area_width),
        (pitch.goal_area_depth, pitch.goal_area_width),
    ):
        _box(axes, line, -width / 2, -sign * depth, width)
    for y in (-pitch.touch_line, pitch.touch_line):
        quarter = {(1, 1): 180, (1, -1): 90, (-1, 1): 270, (-1, -1): 0}[sign, 1 if y > 0 else -1]
        _arc(axes, line, y, pitch.corner_arc_radius, quarter, quarter + 90)
    _goal(axes, pitch, sign)


def _goal(axes: Axes, pitch: Pitch, sign: int) -> None:
    line, half = sign * pitch.goal_line, pitch.goal_width / 2
    axes.add_patch(
        Rectangle(
            (line, -half),
            sign * pitch.goal_depth,
            pitch.goal_width,
            facecolor="#ffffff22",
            edgecolor=_NET,
            hatch="xxxxx",
            lw=0.4,
            zorder=1,
        )
    )
    frame_x = [line, line + sign * pitch.goal_depth, line + sign * pitch.goal_depth, line]
    axes.plot(frame_x, [-half, -half, half, half], color="white", lw=2.0, solid_capstyle="round", zorder=2)


def _box(axes: Axes, x: float, y: float, width: float, height: float) -> None:
    axes.add_patch(Rectangle((x, y), width, height, fill=False, edgecolor=_LINE, lw=1.3, zorder=1))


def _arc(axes: Axes, x: float, y: float, radius: float, start: float, end: float) -> None:
    axes.add_patch(Arc((x, y), 2 * radius, 2 * radius, theta1=start, theta2=end, edgecolor=_LINE, lw=1.3, zorder=1))
