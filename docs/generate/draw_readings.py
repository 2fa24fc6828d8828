"""Draws what robots last read by their sensors: beams to what they met, touched sectors, measured headings."""

import cmath
import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from schemas.config.sensors.compass import CompassReading
from schemas.config.sensors.contact import ContactReading
from schemas.config.sensors.range import RangeReading
from schemas.config.sensors.table import Reading
from schemas.messages.setup import Setup
from schemas.messages.world import RobotTruth, World
from touchline.drawing.bodies import COLOURS

_TOUCH, _HEADING = "#ff3b30", "#ffffff"
_AROUND = 2.2
"""Radius of the ring of sectors, in radii of the hull: outside the robot as it is drawn."""
_NEEDLE = 4.0
"""Length of a compass needle, in radii of the hull."""
_ARC_STEPS = 12
Lines = list[list[complex]]
"""Lines through points in the field frame, x + i·y in m."""


def draw_readings(axes: Axes, setup: Setup, worlds: Sequence[World], scale: float) -> None:
    """Draw the newest reading of each sensor, where its robot was; `scale` is inches on paper per metre."""
    newest: dict[tuple[str, str], tuple[RobotTruth, Reading]] = {}
    for world in worlds:
        for robot, readings in world.sensors.items():
            newest |= {(robot, name): (world.robots[robot], reading) for name, reading in readings.items()}
    for (robot, name), (truth, reading) in newest.items():
        sensors, side = setup.sensors_of(robot), setup.sides.get(robot)
        if name not in sensors or side is None:
            continue
        place, turn = complex(truth.x, truth.y), cmath.rect(1.0, truth.heading)
        radius = setup.for_robot(robot).robot.radius
        if isinstance(reading, RangeReading):
            x, y, _ = sensors[name].mount
            lines = _beams(reading, place + complex(x, y) * turn, truth.heading)
            _draw(axes, lines, COLOURS[side], 1.5 * scale, 0.6)
            ends = [line[-1] for line in lines]
            axes.plot([end.real for end in ends], [end.imag for end in ends], ".", color=COLOURS[side], ms=7 * scale)
        elif isinstance(reading, ContactReading):
            _draw(axes, _sectors(reading, place, truth.heading, _AROUND * radius), _TOUCH, 7 * scale, 1.0)
        elif isinstance(reading, CompassReading):
            needle = [place, place + cmath.rect(_NEEDLE * radius, reading.heading)]
            _draw(axes, [needle], _HEADING, 3 * scale, 0.8)


def _beams(reading: RangeReading, eye: complex, heading: float) -> Lines:
    """The beams that met something."""
    angles = [heading + reading.angle_min + beam * reading.angle_increment for beam in range(len(reading.distances))]
    found = zip(angles, reading.distances, strict=True)
    return [[eye, eye + cmath.rect(away, angle)] for angle, away in found if away is not None]


def _sectors(reading: ContactReading, place: complex, heading: float, radius: float) -> Lines:
    """Arcs along the touched sectors."""
    width = math.tau / len(reading.touched)
    starts = [heading + (sector - 0.5) * width for sector, touched in enumerate(reading.touched) if touched]
    shares = [step / _ARC_STEPS for step in range(_ARC_STEPS + 1)]
    return [[place + cmath.rect(radius, start + share * width) for share in shares] for start in starts]


def _draw(axes: Axes, lines: Lines, colour: str, width: float, opacity: float) -> None:
    points = [[(point.real, point.imag) for point in line] for line in lines]
    axes.add_collection(LineCollection(points, colors=colour, linewidths=width, alpha=opacity, zorder=2.9))
