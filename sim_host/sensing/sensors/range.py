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
_LEAST = 1e-12
"""m, to avoid a division by zero."""
_SHIFTS = np.array([[0.0], [1.0]])
"""Whole turns back: a body may cover the end of the span and its beginning."""


class ComputedRange:
    """A range finder on several robots; arrays are robots × beams."""

    def __init__(self, carried: Carried) -> None:
        s: RangeFinder = carried.numbers
        self._numbers, pitch = s, carried.pitch
        self._robots = np.array(carried.robots)
        self._angles = s.angle_min + s.angle_increment * np.arange(s.beams)
        self._ways = np.exp(1j * self._angles)
        self._place = complex(s.x, s.y)
        walls = pitch.goal_line + pitch.border, pitch.touch_line + pitch.border
        self._walls = walls if pitch.boundary_height >= s.height else (np.inf, np.inf)
        self._shapes = Shapes(carried.roster.models, s.height, carried.ball_radius if s.ball == "seen" else None)
        self._noise = carried.normals(s.beams) if s.noise or s.noise_share else None
        self._dropout = carried.uniforms(s.beams) if s.dropout else None

    def read(self, snapshot: Snapshot, number: int) -> Sequence[Reading]:
        """A reading for each robot."""
        s, distance = self._numbers, self.distances(snapshot)
        if self._noise is not None:
            share = s.noise_share * np.minimum(distance, s.max_distance) if s.noise_share else 0.0
            sigma = np.hypot(s.noise, share)
            distance = np.maximum(distance + sigma * self._noise.at(number), 0.0)
        lost = (distance < s.min_distance) | (distance > s.max_distance)
        if self._dropout is not None:
            lost |= self._dropout.at(number) < s.dropout
        distance = rounded(distance)
        distance[lost] = np.nan  # is written as null
        angles = {"angle_min": s.angle_min, "angle_increment": s.angle_increment}
        return [RangeReading(age=0.0, **angles, distances=one) for one in distance.tolist()]

    def distances(self, snapshot: Snapshot) -> Floats:
        """The true distances in m, shape (robots, beams)."""
        motions = snapshot.robots.motions
        turn = np.exp(1j * motions.heading[self._robots])
        eyes = motions.position[self._robots] + self._place * turn
        ways = self._ways * turn[:, None]
        found = self._to_walls(eyes, ways)
        shapes = self._shapes.at(snapshot)
        away = (shapes.centre - eyes[:, None]) / turn[:, None]
        gap = np.abs(away)
        near = gap < self._numbers.max_distance + shapes.reach
        near &= shapes.owner != self._robots[:, None]
        robot, shape = near.nonzero()
        if not len(robot):
            return found
        pair, beam = self._beams_near(away[near], gap[near], shapes.reach[shape])
        robot, shape = robot[pair], shape[pair]
        hit = shapes.distances(shape, eyes[robot], ways[robot, beam])
        np.minimum.at(found, (robot, beam), hit)
        return found

    def _to_walls(self, eyes: Vectors, ways: Vectors) -> Floats:
        """Distance from each eye, within the boundary, to the wall along each beam."""
        to_x, to_y = ways.real, ways.imag
        with np.errstate(divide="ignore", invalid="ignore"):  # along a wall
            x = (np.copysign(self._walls[0], to_x) - eyes.real[:, None]) / to_x
            found: Floats = np.minimum(x, (np.copysign(self._walls[1], to_y) - eyes.imag[:, None]) / to_y)
        found[~(found >= 0.0)] = np.inf  # outside the boundary, or not a number
        return found

    def _beams_near(self, away: Vectors, gap: Floats, reach: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Index of the pair of sensor and shape, and beam, for all beams within the bearings that the shape covers.

        `away` are the centres in the robot's frame.
        """
        step = self._numbers.angle_increment or 1.0
        half = np.where(gap > reach, np.arcsin(reach / np.maximum(gap, reach + _LEAST)), np.pi) + 1e-9
        low, turn = (np.angle(away) - half - self._angles[0]) / step, _TURN / step
        low = low - (np.floor(low / turn) + _SHIFTS) * turn
        first = np.maximum(np.ceil(low), 0.0)
        last = np.minimum(np.floor(low + 2.0 * half / step), self._numbers.beams - 1.0)
        count = np.maximum(last - first + 1.0, 0.0).astype(np.intp).ravel()
        pair = np.arange(len(count)).repeat(count)
        start = count.cumsum() - count - first.astype(np.intp).ravel()
        return pair % len(gap), np.arange(len(pair)) - start[pair]
