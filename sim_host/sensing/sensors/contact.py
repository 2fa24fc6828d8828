"""Computes bumpers: contacts of robots from the engine, contacts with obstacles and boundary from the hull's outline.

The outline is a ring of points on the hull, dense enough that nothing wider than the gap passes between two of them.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from schemas.config.obstacle import Shape
from schemas.config.sections import RobotBody
from schemas.config.sensors.contact import Bumper, ContactReading
from schemas.config.sensors.table import Reading
from sim_host.sensing.random_streams import Vectors
from sim_host.sensing.sensors.carried import Carried
from sim_host.sensing.sight_lines import Flags
from sim_host.snapshot import Snapshot

_POINTS = 128
"""Points on the outline: at most 4 mm apart on the largest side of a usual hull."""


class ComputedContact:
    """A bumper on several robots."""

    def __init__(self, carried: Carried) -> None:
        self._numbers: Bumper = carried.numbers
        self._robots = carried.robots
        pitch = carried.pitch
        self._walls = pitch.goal_line + pitch.border, pitch.touch_line + pitch.border
        self._outline = np.stack([outline(carried.roster.models[place].body) for place in carried.robots])
        """Points of each hull in its robot's frame, (robots, points)."""
        self._sectors = self._sector_of(np.angle(self._outline))

    def read(self, snapshot: Snapshot, number: int) -> Sequence[Reading]:
        """A reading for each robot."""
        del number
        motions, robots = snapshot.robots.motions, np.array(self._robots)
        turn = np.exp(1j * motions.heading[robots])[:, None]
        points = motions.position[robots][:, None] + self._outline * turn
        touches = self._touches_fixed(points, snapshot)
        touched = np.zeros((len(robots), self._numbers.sectors), dtype=bool)
        robot, point = touches.nonzero()
        touched[robot, self._sectors[robot, point]] = True
        for pair in snapshot.contacts:
            for me, other in (pair, pair[::-1]):
                if me in self._robots:
                    away = (motions.position[other] - motions.position[me]) * np.exp(-1j * motions.heading[me])
                    touched[self._robots.index(me), self._sector_of(np.angle(away))] = True
        return [ContactReading(age=0.0, touched=sectors) for sectors in touched.tolist()]

    def _sector_of(self, bearing: NDArray[np.float64]) -> NDArray[np.intp]:
        """The sector at these bearings from the kick axis, in rad."""
        share = bearing / (2.0 * np.pi) * self._numbers.sectors
        return np.asarray(np.floor(share + 0.5)).astype(np.intp) % self._numbers.sectors

    def _touches_fixed(self, points: Vectors, snapshot: Snapshot) -> Flags:
        """Which points of the hulls touch an obstacle or the boundary."""
        gap, (wall_x, wall_y) = self._numbers.gap, self._walls
        touches: Flags = (np.abs(points.real) >= wall_x - gap) | (np.abs(points.imag) >= wall_y - gap)
        for one in snapshot.obstacles:
            places = points - complex(one.x, one.y)
            if one.shape is Shape.CYLINDER:
                touches |= np.abs(places) <= one.radius + gap
                continue
            places *= np.exp(-1j * one.heading)
            beside = np.maximum(np.abs(places.real) - one.size_x / 2, 0.0)
            ahead = np.maximum(np.abs(places.imag) - one.size_y / 2, 0.0)
            touches |= np.hypot(beside, ahead) <= gap
        return touches


def outline(body: RobotBody) -> Vectors:
    """Points on a hull in its robot's frame, in m, at equal bearings."""
    ways = np.exp(2j * np.pi * np.arange(_POINTS) / _POINTS)
    away = np.full(_POINTS, body.radius)
    if body.frame_width:
        back, half = body.radius - body.frame_depth, body.frame_width / 2
        for place, way in enumerate(ways):
            away[place] = max(body.radius, _leaves_box(way, back, body.radius, half))
    points: Vectors = away * ways
    return points


def _leaves_box(way: complex, back: float, front: float, half: float) -> float:
    """Distance at which a line from the axis along `way` leaves a frame from `back` to `front`; 0 if it misses it."""
    x, y = way.real, way.imag
    enters, leaves = 0.0, math.inf
    for along, low, high in ((x, back, front), (y, -half, half)):
        if abs(along) < 1e-12:
            if not low <= 0.0 <= high:
                return 0.0
            continue
        one, other = sorted((low / along, high / along))
        enters, leaves = max(enters, one), min(leaves, other)
    return leaves if enters < leaves else 0.0
