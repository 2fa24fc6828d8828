"""Circles and boxes that beams at one height meet: hulls and frames of robots, obstacles, the ball."""

import numpy as np
from numpy.typing import NDArray

from schemas.config.obstacle import Shape
from schemas.config.sensors.range import RangeFinder
from sim_host.sensing.random_streams import Floats, Vectors
from sim_host.sensing.sensors.carried import Carried
from sim_host.sensing.sight_lines import box_crossings
from sim_host.snapshot import ObstacleState, Snapshot

_NOBODY = -1


class Shapes:
    """All shapes of a snapshot, in arrays: robots' hulls, their frames, obstacles, and the ball last."""

    def __init__(self, carried: Carried) -> None:
        """`carried` is the range finder that meets them."""
        self._numbers: RangeFinder = carried.numbers
        self._eyes, bodies = np.array(carried.robots)[:, None], [model.body for model in carried.roster.models]
        self._balls = [carried.ball_radius] if self._numbers.ball == "seen" else []
        tall = [place for place, body in enumerate(bodies) if body.height >= self._numbers.height]
        framed = [place for place in tall if bodies[place].frame_width]
        self._tall, self._framed = np.array(tall, dtype=np.intp), np.array(framed, dtype=np.intp)
        self._ahead = np.array([bodies[place].radius - bodies[place].frame_depth / 2 for place in framed])
        self._robot_radius = [bodies[place].radius for place in tall] + [0.0] * len(framed)
        self._robot_halves = [(0.0, 0.0)] * len(tall)
        self._robot_halves += [(bodies[place].frame_depth / 2, bodies[place].frame_width / 2) for place in framed]
        self._obstacles: tuple[ObstacleState, ...] | None = None
        self._prepare(())

    def _prepare(self, obstacles: tuple[ObstacleState, ...]) -> None:
        """Compute all that is the same for the same obstacles."""
        self._obstacles = obstacles
        met = [one for one in obstacles if one.height >= self._numbers.height]
        robots, balls = len(self._robot_radius), len(self._balls)
        circles = [one.radius if one.shape is Shape.CYLINDER else 0.0 for one in met]
        boxes = [(0.0, 0.0) if one.shape is Shape.CYLINDER else (one.size_x / 2, one.size_y / 2) for one in met]
        self.radius = np.array(self._robot_radius + circles + self._balls)
        """m; 0 for a box."""
        self.halves = np.array(self._robot_halves + boxes + [(0.0, 0.0)] * balls).reshape(-1, 2).T
        """m; half depth and width of a box; 0 for a circle."""
        self._has_boxes = bool(self.halves.any())
        self.reach: Floats = np.maximum(self.radius, np.hypot(*self.halves))
        """m; of the circle around each."""
        owner = np.concatenate((self._tall, self._framed, [_NOBODY] * (len(met) + balls)))
        self.farthest: Floats = np.where(owner == self._eyes, 0.0, self._numbers.max_distance + self.reach)
        """m, shape (eyes, shapes); a centre beyond it meets no beam, and the own hull is transparent."""
        self.centre: Vectors = np.array([0j] * robots + [complex(one.x, one.y) for one in met] + [0j] * balls)
        self.axis: Vectors = np.exp(1j * np.array([0.0] * robots + [one.heading for one in met] + [0.0] * balls))
        """Direction of a box, of unit length."""

    def at(self, snapshot: Snapshot) -> "Shapes":
        """These shapes at their places in a snapshot, valid until the next call."""
        if snapshot.obstacles != self._obstacles:
            self._prepare(snapshot.obstacles)
        motions, tall = snapshot.robots.motions, len(self._tall)
        self.centre[:tall] = motions.position.take(self._tall)
        if len(self._framed):
            framed = slice(tall, tall + len(self._framed))
            self.axis[framed] = np.exp(1j * motions.heading.take(self._framed))
            self.centre[framed] = motions.position.take(self._framed) + self._ahead * self.axis[framed]
        for radius in self._balls:
            ball = snapshot.ball_state
            square = 0.0 if ball is None else radius**2 - (ball.z - self._numbers.height) ** 2
            self.centre[-1] = complex(ball.x, ball.y) if ball is not None and square > 0.0 else 1e9
            self.radius[-1] = self.reach[-1] = max(square, 0.0) ** 0.5
        return self

    def distances(self, shape: NDArray[np.intp], away: Vectors, ways: Vectors, turn: Vectors) -> Floats:
        """Distance in m from each eye along a beam of unit length to the outline of a shape; inf where it misses a box.

        `away` are the centres of the shapes as seen from the eyes, and `ways` the beams, in frames turned by `turn`.
        All beams are within the bearings that the circle around the shape covers. An eye within a shape is at distance
        0 from it.
        """
        if not self._has_boxes:
            return self._to_circles(shape, away, ways)
        is_box = self.radius[shape] == 0.0
        found = np.empty(len(shape))
        circle, box = np.flatnonzero(~is_box), np.flatnonzero(is_box)
        found[circle] = self._to_circles(shape[circle], away[circle], ways[circle])
        found[box] = self._to_boxes(shape[box], away[box] * turn[box], ways[box] * turn[box])
        return found

    def _to_circles(self, shape: NDArray[np.intp], away: Vectors, ways: Vectors) -> Floats:
        seen = away * ways.conj()
        square = self.radius.take(shape) ** 2 - seen.imag**2
        return np.maximum(seen.real - np.sqrt(np.maximum(square, 0.0)), 0.0)

    def _to_boxes(self, shape: NDArray[np.intp], away: Vectors, ways: Vectors) -> Floats:
        back = self.axis[shape].conj()
        enters, leaves = box_crossings(-away * back, ways * back, self.halves[:, shape])
        misses = (enters > leaves) | (leaves < 0.0)
        found: Floats = np.where(misses, np.inf, np.maximum(enters, 0.0))
        return found
