"""Computes compasses: the true heading with a constant, a wandering and a random error."""

from collections.abc import Sequence

import numpy as np

from schemas.config.sensors.compass import Compass, CompassReading
from schemas.config.sensors.table import Reading
from sim_host.sensing.digits import rounded
from sim_host.sensing.random_streams import Floats
from sim_host.sensing.sensors.carried import Carried
from sim_host.snapshot import Snapshot


class ComputedCompass:
    """A compass on several robots."""

    def __init__(self, carried: Carried) -> None:
        self._numbers: Compass = carried.numbers
        self._carried = carried
        self._robots = np.array(carried.robots)
        self._noise = carried.normals(1)
        self._drift_ticks = self._numbers.drift_time / carried.tick

    def read(self, snapshot: Snapshot, number: int) -> Sequence[Reading]:
        """A reading for each robot."""
        heading = snapshot.robots.motions.heading[self._robots] + self._numbers.bias
        if self._numbers.noise:
            heading += self._numbers.noise * self._noise.at(number)[:, 0]
        if self._numbers.drift:
            heading += self._numbers.drift * self._drift(snapshot.tick)
        wrapped = rounded(np.pi - (np.pi - heading) % (2.0 * np.pi)).tolist()
        return [CompassReading(age=0.0, heading=one) for one in wrapped]

    def _drift(self, tick: int) -> Floats:
        """The wandering error in units of its deviation, made as in `sim_host.sensing.drift`."""
        knot, share = divmod(tick / self._drift_ticks, 1.0)
        before, after = self._carried.knots([int(knot), int(knot) + 1])
        turn = 0.5 * np.pi * share
        drift: Floats = np.cos(turn) * before + np.sin(turn) * after
        return drift
