"""What each robot perceives of the truth, in its team frame, with Gaussian noise; never touches the truth."""

import numpy as np

from schemas.profile import Sensing
from sim_host.sensing.streams import Block, Floats, Streams, What
from sim_host.snapshot import Roster, Snapshot

_OWN = 6
_BALL = 5
_BEFORE_OBSTACLES = _OWN + _BALL


Percept = list[float]
"""What one robot perceives: own x, y, heading, vx, vy, omega; ball x, y, z, vx, vy; x and y of each obstacle."""


class Perception:
    """The sensors of all robots of a match: one row of numbers a robot, all robots at once."""

    def __init__(self, sensing: Sensing, roster: Roster, streams: Streams) -> None:
        self._roster = roster
        self._streams = streams
        s, count = sensing, len(roster.names)
        own = [s.own_position] * 2 + [s.own_heading] + [s.own_velocity] * 2 + [s.own_turn_rate]
        ball = [s.ball_position] * 3 + [s.ball_velocity] * 2
        self._sigma = np.array(own + ball + [s.obstacle_position] * 2 * count)
        self._rows = np.arange(count)
        self._attack = {
            attacks: np.array([[float(side.attack(attacks))] for side in roster.sides]) for attacks in (1, -1)
        }
        self._turned = {attacks: np.where(sign[:, 0] > 0, 0.0, np.pi) for attacks, sign in self._attack.items()}
        self._noise = Block(self._draw)
        self._columns = np.r_[:_BEFORE_OBSTACLES, _BEFORE_OBSTACLES + 2 : len(self._sigma)]
        """All but the first obstacle, which is the robot itself."""

    def at(self, snapshot: Snapshot, cyan_attacks: int) -> list[Percept]:
        """Everyone's percept, in the order of the roster."""
        robots = np.array(snapshot.robots)
        seen = self._noise.at(snapshot.tick).copy()
        sign = self._attack[cyan_attacks]
        positions = sign * robots[:, :2]
        seen[:, :2] += positions
        seen[:, 2] = _wrapped(seen[:, 2] + robots[:, 3] + self._turned[cyan_attacks])
        seen[:, 3:5] += sign * robots[:, 4:6]
        seen[:, 5] += robots[:, 6]
        bx, by, bz, bvx, bvy, _ = snapshot.ball
        seen[:, 6:_BEFORE_OBSTACLES] += sign * (bx, by, 0.0, bvx, bvy)
        seen[:, 8] += bz
        obstacles = seen[:, _BEFORE_OBSTACLES:].reshape(len(robots), len(robots), 2)
        obstacles += sign[:, None] * robots[:, :2]
        obstacles[:] = self._nearest_first(obstacles, positions)
        percepts: list[Percept] = seen[:, self._columns].tolist()
        return percepts

    def _nearest_first(self, obstacles: Floats, positions: Floats) -> Floats:
        """Each robot's obstacles by distance, itself first: their order tells nobody's name."""
        away = obstacles - positions[:, None]
        distance = away[:, :, 0] ** 2 + away[:, :, 1] ** 2
        distance[self._rows, self._rows] = -1.0
        order = distance.argsort(axis=1, kind="stable")
        nearest: Floats = obstacles[self._rows[:, None], order]
        return nearest

    def _draw(self, ticks: range) -> Floats:
        names, draw = self._roster.names, self._streams.normals
        parts = ((What.OWN, _OWN), (What.BALL, _BALL), (What.OBSTACLE, 2 * len(names)))
        noise: Floats = np.concatenate([draw(what, names, ticks, count) for what, count in parts], axis=2)
        scaled: Floats = noise * self._sigma
        return scaled


def _wrapped(angle: Floats) -> Floats:
    """The same directions in (−π, π]."""
    return np.pi - np.mod(np.pi - angle, 2.0 * np.pi)
