"""Computes range finders: casts beams against hulls, obstacles and the boundary, all seen from above.

Most of the bodies are far from most of the beams. Seen from a sensor, a body covers the bearings around its own, so
only the beams within these bearings are tried against it.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from schemas.config.sensors.range import RangeFinder, RangeReading
from schemas.config.sensors.table import Reading
from sim_host.sensing.digits import rounded
from sim_host.sensing.random_streams import Floats, Vectors
from sim_host.sensing.sensors.carried import Carried
from sim_host.sensing.sensors.shapes import Shapes
from sim_host.snapshot import Snapshot

_TURN = 2.0 * np.pi
_MARGIN = np.array(1e-9)
"""rad by which a shadow is widened, and m by which an eye is within the boundary, for rounding errors."""
_EDGES = np.array([-1.0, 1.0])[:, None, None]


class ComputedRange:
    """A range finder on several robots; arrays are robots × beams, and bearings are counted from the first beam."""

    def __init__(self, carried: Carried) -> None:
        s: RangeFinder = carried.numbers
        self._numbers, pitch = s, carried.pitch
        self._robots = np.array(carried.robots)
        self._bearings = {"angle_min": s.angle_min, "angle_increment": s.angle_increment}
        self._place, self._first = complex(s.x, s.y), np.exp(1j * s.angle_min)
        self._ways = np.exp(1j * s.angle_increment * np.arange(s.beams))
        self._step = np.maximum(s.angle_increment, _MARGIN)
        self._shifts = np.array([[0.0], [_TURN]]) + self._step
        """rad; a body may cover the end of the span and its beginning. The first beam after a bearing is counted."""
        walls = pitch.goal_line + pitch.border, pitch.touch_line + pitch.border
        self._walls = np.array(walls if pitch.boundary_height >= s.height else (1e9, 1e9))[:, None, None]
        self._shapes = Shapes(carried)
        self._errors = carried.errors(s.beams, s.dropout) if s.noise or s.noise_share or s.dropout else None

    def read(self, snapshot: Snapshot, number: int) -> Sequence[Reading]:
        """A reading for each robot."""
        s, distance = self._numbers, self.distances(snapshot)
        if self._errors is not None:
            sigma: float | Floats = s.noise
            if s.noise_share:
                sigma = np.hypot(s.noise, s.noise_share * np.minimum(distance, s.max_distance))
            distance += sigma * self._errors.at(number)
            np.maximum(distance, 0.0, out=distance)
        returns = (distance >= s.min_distance) & (distance <= s.max_distance)
        distances = np.empty(distance.shape, dtype=object)  # None in each place
        distances[returns] = rounded(distance[returns])
        return [RangeReading(age=0.0, **self._bearings, distances=one) for one in distances.tolist()]

    def distances(self, snapshot: Snapshot) -> Floats:
        """The true distances in m, shape (robots, beams)."""
        motions, shapes = snapshot.robots.motions, self._shapes.at(snapshot)
        turn = np.exp(1j * motions.heading.take(self._robots))
        eyes = (motions.position.take(self._robots) + self._place * turn)[:, None]
        turn = (turn * self._first)[:, None]
        found = self._to_walls(eyes, turn * self._ways)
        away = (shapes.centre - eyes) * turn.conj()
        gap = np.abs(away)
        near = gap < shapes.farthest
        robot, shape = near.nonzero()
        if not len(robot):
            return found
        away = away[near]
        pair, beam = self._beams_near(away, gap[near], shapes.reach.take(shape))
        robot = robot.take(pair)
        hit = shapes.distances(shape.take(pair), away.take(pair), self._ways.take(beam), turn.take(robot))
        np.minimum.at(found, (robot, beam), hit)
        return found

    def _to_walls(self, eyes: Vectors, ways: Vectors) -> Floats:
        """Distance from each eye to the boundary along each beam; an eye beyond it is on it."""
        eye, way = np.array((eyes.real, eyes.imag)), np.array((ways.real, ways.imag))
        ahead, behind = np.maximum(self._walls - eye, _MARGIN), np.minimum(-self._walls - eye, -_MARGIN)
        nearness = np.maximum(way / ahead, way / behind)
        distance: Floats = 1.0 / np.maximum(nearness[0], nearness[1])
        return distance

    def _beams_near(self, away: Vectors, gap: Floats, reach: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Index of the pair of sensor and shape, and beam, for all beams within the bearings that the shape covers.

        `away` are the centres as seen from the sensor along its first beam.
        """
        half = np.arcsin(reach / np.maximum(gap, reach))
        half[gap <= reach] = np.pi
        half += _MARGIN
        edges = (np.arctan2(away.imag, away.real) + self._shifts + _EDGES * half) / self._step
        start, stop = np.minimum(np.maximum(edges, 0.0), self._numbers.beams).astype(np.intp).reshape(2, -1)
        count = stop - start
        pair = np.arange(len(away))
        pair = np.concatenate((pair, pair)).repeat(count)
        return pair, np.arange(len(pair)) + (stop - count.cumsum()).repeat(count)
