"""Computes bumpers: beams all round, near the ground, that end within the gap of the hull."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from schemas.config.sections import RobotBody
from schemas.config.sensors.contact import Bumper, ContactReading
from schemas.config.sensors.range import RangeFinder
from schemas.config.sensors.table import Reading
from sim_host.sensing.random_streams import Floats
from sim_host.sensing.sensors.carried import Carried
from sim_host.sensing.sensors.range import ComputedRange
from sim_host.sensing.sight_lines import box_crossings
from sim_host.snapshot import Snapshot

_BEAMS = 128
"""12 mm apart on a usual hull; where two of them touch, the nearest beam is longer by 0.2 mm at most."""


class ComputedContact:
    """A bumper on several robots."""

    def __init__(self, carried: Carried) -> None:
        self._numbers: Bumper = carried.numbers
        bodies = [carried.roster.models[place].body for place in carried.robots]
        reach = max(body.reach for body in bodies) + self._numbers.gap
        beams = RangeFinder(beams=_BEAMS, span=2.0 * np.pi, max_distance=reach, height=0.0)
        self._beams = ComputedRange(dataclasses.replace(carried, numbers=beams))
        bearings: Floats = beams.angle_min + beams.angle_increment * np.arange(float(_BEAMS))
        self._felt = np.stack([_outline(body, bearings) for body in bodies]) + self._numbers.gap
        share = bearings / (2.0 * np.pi) * self._numbers.sectors
        self._sectors = np.floor(share + 0.5).astype(np.intp) % self._numbers.sectors

    def read(self, snapshot: Snapshot, number: int) -> Sequence[Reading]:
        """A reading for each robot."""
        del number
        robot, beam = (self._beams.distances(snapshot) <= self._felt).nonzero()
        touched = np.zeros((len(self._felt), self._numbers.sectors), dtype=bool)
        touched[robot, self._sectors[beam]] = True
        return [ContactReading(age=0.0, touched=sectors) for sectors in touched.tolist()]


def _outline(body: RobotBody, bearings: Floats) -> Floats:
    """Distance in m from the axis to the outline of the hull and its frame at these bearings from the kick axis."""
    if not body.frame_width:
        return np.full(len(bearings), body.radius)
    halves = np.array([[body.frame_depth], [body.frame_width]]) / 2
    enters, leaves = box_crossings(halves[0] - body.radius + 0j, np.exp(1j * bearings), halves)
    return np.where(enters < leaves, np.maximum(leaves, body.radius), body.radius)
