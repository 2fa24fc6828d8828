"""Draws robots, ball and obstacles on the floor, and the trails of moving bodies."""

import math
import re
from collections.abc import Sequence
from itertools import pairwise

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from matplotlib.patches import Circle, Polygon, Rectangle

from schemas.config.obstacle import Shape
from schemas.frames import Point
from schemas.messages.setup import Setup
from schemas.messages.world import BallTruth, ObstacleTruth, World
from schemas.side import Side

COLOURS = {Side.CYAN: "#22c3dd", Side.MAGENTA: "#e0389a"}
_EDGES = {Side.CYAN: "#073b45", Side.MAGENTA: "#4a0730"}
_BALL = "#ffb000"
_OBSTACLE = "#5d6470"
_ROBOT_SCALE = 1.9
"""Scale at which robots are drawn: in true size, their numbers would be unreadable."""
_BALL_SCALE = 1.6
_JUMP_M = 1.0
"""A body that moves farther in one tick was placed by hand: its trail is interrupted."""


def draw_bodies(axes: Axes, setup: Setup, worlds: Sequence[World], scale: float) -> None:
    """Draw the last of `worlds`, with trails through the others; `scale` is inches on paper per metre."""
    now = worlds[-1]
    for obstacle in now.obstacles.values():
        _obstacle(axes, obstacle, scale)
    sides = setup.sides
    for name, robot in now.robots.items():
        if robot.off_field is not None or name not in sides:
            continue
        side = sides[name]
        way = [(world.robots[name].x, world.robots[name].y) for world in worlds if name in world.robots]
        _trail(axes, way, COLOURS[side], 6.0 * scale)
        radius = _ROBOT_SCALE * setup.for_robot(name).robot.radius
        _robot(axes, (robot.x, robot.y), robot.heading, radius, side, _number(name, setup), scale)
    _trail(axes, [(ball.x, ball.y) for world in worlds if (ball := world.ball) is not None], _BALL, 7.5 * scale)
    if now.ball is not None:
        _ball(axes, now.ball, setup.ball.radius, scale)


def _trail(axes: Axes, way: Sequence[Point], colour: str, width: float) -> None:
    """Draw a line that fades toward the past."""
    steps = list(pairwise(way))
    kept = [(number, step) for number, step in enumerate(steps, 1) if math.dist(*step) <= _JUMP_M]
    if not kept:
        return
    ages = [number / len(steps) for number, _ in kept]
    axes.add_collection(
        LineCollection(
            [step for _, step in kept],
            colors=[(*to_rgb(colour), 0.85 * age**1.3) for age in ages],
            linewidths=[width * (0.35 + 0.65 * age) for age in ages],
            capstyle="butt",
            zorder=2.5,
        )
    )


def _obstacle(axes: Axes, obstacle: ObstacleTruth, scale: float) -> None:
    """Draw an obstacle in true size."""
    x, y = obstacle.x, obstacle.y
    look = {"facecolor": _OBSTACLE, "edgecolor": "#23272e", "lw": 2.0 * scale, "zorder": 2.8}
    if obstacle.shape is Shape.CYLINDER:
        axes.add_patch(Circle((x, y), obstacle.radius, **look))
        return
    corner = x - obstacle.size_x / 2, y - obstacle.size_y / 2
    turned = math.degrees(obstacle.heading)
    axes.add_patch(Rectangle(corner, obstacle.size_x, obstacle.size_y, angle=turned, rotation_point="center", **look))


def _robot(axes: Axes, place: Point, heading: float, radius: float, side: Side, number: str, scale: float) -> None:
    """Draw a disc with its number, and a nose in the kicking direction."""
    x, y = place
    nose = [
        (x + reach * radius * math.cos(heading + turn), y + reach * radius * math.sin(heading + turn))
        for turn, reach in ((-0.5, 0.96), (0.0, 1.5), (0.5, 0.96))
    ]
    axes.add_patch(Circle((x + 0.06, y - 0.09), radius * 1.04, color="#00000038", lw=0, zorder=3))
    axes.add_patch(Polygon(nose, facecolor=_EDGES[side], lw=0, zorder=3.1))
    axes.add_patch(Circle(place, radius, facecolor=COLOURS[side], edgecolor=_EDGES[side], lw=3.2 * scale, zorder=3.2))
    text = axes.text(x, y - 0.02, number, color="white", fontsize=25 * scale, fontweight="bold", zorder=3.3)
    text.set(ha="center", va="center_baseline")


def _ball(axes: Axes, ball: BallTruth, true_radius: float, scale: float) -> None:
    """Draw the ball above its shadow: the higher it is, the larger and the farther from the shadow."""
    x, y, lift = ball.x, ball.y, max(0.0, ball.z - true_radius)
    radius = _BALL_SCALE * true_radius
    axes.add_patch(Circle((x + 0.05, y - 0.07), radius, color="#00000055", lw=0, zorder=4))
    shown = radius * (1 + 0.3 * lift)
    axes.add_patch(Circle((x, y + 0.6 * lift), shown, facecolor=_BALL, edgecolor="#5a3c00", lw=2.2 * scale, zorder=4.1))


def _number(name: str, setup: Setup) -> str:
    """The number at the end of a robot's name, or else its position in the team, from 1."""
    found = re.search(r"\d+$", name)
    if found:
        return found[0]
    return str(next(team.robots.index(name) + 1 for team in setup.teams.values() if name in team.robots))
