"""Drift: the wandering error of a robot's estimate of its team frame.

Drift has no state. There is a knot, an independent draw, at every multiple of the drift time. Between two knots the
drift is their sum with weights cos and sin of a quarter turn, whose squares sum to 1, so that it has the same standard
deviation at all times.
"""

import numpy as np

from schemas.config.sections import Sensing
from sim_host.sensing.random_streams import RandomStreams, StreamId, Vectors
from sim_host.sensing.team_frames import TeamFrames
from sim_host.snapshot import Roster

_PARTS = 3


class Drift:
    """The drift of all robots of a match."""

    def __init__(self, sensing: Sensing, roster: Roster, streams: RandomStreams, tick: float) -> None:
        self._names = roster.names
        self._streams = streams
        self._sigma = np.array([sensing.drift_position] * 2 + [sensing.drift_heading])
        self._ticks = sensing.drift_time / tick

    def frames(self, ticks: range, sign: Vectors) -> list[TeamFrames]:
        """The believed team frames of all robots at each of these ticks; `sign` is that of `TeamFrames`."""
        drift = self._drift(ticks)
        shift, turn = drift[:, 0], sign * drift[:, 1]
        angle = np.arctan2(turn.imag, turn.real)
        return [TeamFrames(sign, *arrays) for arrays in zip(shift, turn, angle, strict=True)]

    def _drift(self, ticks: range) -> Vectors:
        """In the team frame of each robot: x + iy in m, and the turn by θ as e^iθ; shape (ticks, 2, robots)."""
        way = np.array(ticks) / self._ticks
        before = way.astype(int)
        first, last = int(before[0]), int(before[-1]) + 1
        knots = self._streams.normals(StreamId.DRIFT, self._names, range(first, last + 1), _PARTS)
        turn = 0.5 * np.pi * (way - before)[:, None, None]
        drift = np.cos(turn) * knots[before - first] + np.sin(turn) * knots[before - first + 1]
        x, y, heading = np.moveaxis(drift * self._sigma, 2, 0)
        return np.stack((x + 1j * y, np.exp(1j * heading)), axis=1)
