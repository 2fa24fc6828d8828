"""A robot's percept of its own pose and twist: without delay, with noise, in the believed team frame."""

import numpy as np

from schemas.config.sections import Sensing
from sim_host.sensing.digits import rounded
from sim_host.sensing.random_streams import BatchedDraws, Floats, RandomStreams, StreamId
from sim_host.sensing.team_frames import TeamFrames
from sim_host.snapshot import RobotMotions, Roster

_PARTS = 6
_PI, _TAU = np.array(np.pi), np.array(2.0 * np.pi)
"""As arrays, which saves numpy a conversion in every call."""


class OwnMotion:
    """The own motion of all robots of a match, as they perceive it."""

    def __init__(self, sensing: Sensing, roster: Roster, streams: RandomStreams) -> None:
        s = sensing
        self._streams = streams
        self._names = roster.names
        self._sigma = np.array([s.own_position] * 2 + [s.own_heading] + [s.own_velocity] * 2 + [s.own_turn_rate])
        self._rate = s.noise_rate
        self._noise = BatchedDraws(self._draw)
        seen = self._seen = np.empty((len(roster.names), _PARTS))
        self._place, self._velocity = seen[:, 0:2].view(complex)[:, 0], seen[:, 3:5].view(complex)[:, 0]
        self._heading, self._omega = seen[:, 2], seen[:, 5]

    def at(self, tick: int, robots: RobotMotions, frames: TeamFrames) -> list[list[float]]:
        """x, y, heading, vx, vy, omega of each robot in its team frame."""
        seen = self._seen
        np.multiply(frames.sign, robots.position, out=self._place)
        np.add(self._place, frames.shift, out=self._place)
        np.multiply(frames.turn, robots.velocity, out=self._velocity)
        self._heading[...], self._omega[...] = robots.heading, robots.omega
        seen += self._noise.at(tick)
        _rotate(self._heading, frames.angle)
        numbers: list[list[float]] = rounded(seen).tolist()
        return numbers

    def _draw(self, ticks: range) -> list[Floats]:
        """The noise of each of these ticks, shape (robots, 6); all 0 for a reading without noise."""
        noise: Floats = self._streams.normals(StreamId.OWN, self._names, ticks, _PARTS) * self._sigma
        if self._rate < 1.0:
            noise *= self._streams.uniforms(StreamId.OWN_LUCK, self._names, ticks, 1) < self._rate
        return list(noise)


def _rotate(directions: Floats, angle: Floats) -> None:
    """Turn directions by an angle, in place; the results are in (−π, π]."""
    directions += angle
    np.subtract(_PI, directions, out=directions)
    directions %= _TAU
    np.subtract(_PI, directions, out=directions)
