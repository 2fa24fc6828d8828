"""Circles and boxes that beams at one height meet: hulls and frames of robots, obstacles, the ball."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from schemas.config.obstacle import Shape
from schemas.config.robot_model import RobotModel
from sim_host.sensing.random_streams import Floats, Vectors
from sim_host.snapshot import ObstacleState, Snapshot

_LEAST = 1e-12
"""m; smallest component of a beam along a side of a box, to avoid a division by zero."""
_NOBODY = -1


class Shapes:
    """All shapes of a snapshot, in arrays: robots' hulls, their frames, obstacles, and the ball last."""

    def __init__(self, models: Sequence[RobotModel], height: float, ball_radius: float | None) -> None:
        """`height` of the beams, m; `ball_radius` is None if they do not meet the ball."""
        bodies = [model.body for model in models]
        tall = [place for place, body in enumerate(bodies) if body.height >= height]
        framed = [place for place in tall if bodies[place].frame_width]
        self._height, self._ball_radius = height, ball_radius
        self._robots = np.array(tall + framed, dtype=np.intp)
        self._ahead = np.array(
            [0.0] * len(tall) + [bodies[place].radius - bodies[place].frame_depth / 2 for place in framed]
        )
        self._robot_radius = [bodies[place].radius for place in tall] + [0.0] * len(framed)
        self._robot_halves = [(0.0, 0.0)] * len(tall)
        self._robot_halves += [(bodies[place].frame_depth / 2, bodies[place].frame_width / 2) for place in framed]
        self._obstacles: tuple[ObstacleState, ...] | None = None
        self._prepare(())

    def _prepare(self, obstacles: tuple[ObstacleState, ...]) -> None:
        """Compute all that is the same for the same obstacles."""
        self._obstacles = obstacles
        met = [one for one in obstacles if one.height >= self._height]
        balls = 0 if self._ball_radius is None else 1
        circles = [one.radius if one.shape is Shape.CYLINDER else 0.0 for one in met]
        boxes = [(0.0, 0.0) if one.shape is Shape.CYLINDER else (one.size_x / 2, one.size_y / 2) for one in met]
        self.radius = np.array(self._robot_radius + circles + [0.0] * balls)
        """m; 0 for a box."""
        self.halves = np.array(self._robot_halves + boxes + [(0.0, 0.0)] * balls).reshape(-1, 2).T
        """m; half depth and width of a box; 0 for a circle."""
        self._has_boxes = bool(self.halves.any())
        self.reach: Floats = np.maximum(self.radius, np.hypot(*self.halves))
        """m; of the circle around each."""
        self.owner: NDArray[np.intp] = np.concatenate((self._robots, np.full(len(met) + balls, _NOBODY, dtype=np.intp)))
        """Index of the robot whose hull it is, or -1."""
        self.centre: Vectors = np.array(
            [0.0j] * len(self._robots) + [complex(one.x, one.y) for one in met] + [0j] * balls
        )
        self.axis: Vectors = np.exp(
            1j * np.array([0.0] * len(self._robots) + [one.heading for one in met] + [0.0] * balls)
        )
        """Direction of a box, of unit length."""

    def at(self, snapshot: Snapshot) -> "Shapes":
        """These shapes at their places in a snapshot, valid until the next call."""
        if snapshot.obstacles != self._obstacles:
            self._prepare(snapshot.obstacles)
        motions, count = snapshot.robots.motions, len(self._robots)
        axis = np.exp(1j * motions.heading)[self._robots]
        self.axis[:count] = axis
        self.centre[:count] = motions.position[self._robots] + self._ahead * axis
        if self._ball_radius is not None:
            ball, square = snapshot.ball_state, 0.0
            if ball is not None:
                self.centre[-1] = complex(ball.x, ball.y)
                square = self._ball_radius**2 - (ball.z - self._height) ** 2
            self.radius[-1] = self.reach[-1] = max(square, 0.0) ** 0.5
        return self

    def distances(self, shape: NDArray[np.intp], eyes: Vectors, ways: Vectors) -> Floats:
        """Distance in m from each eye along a beam of unit length to the outline of a shape; inf where it misses.

        An eye within a shape is at distance 0 from it.
        """
        if not self._has_boxes:
            return self._to_circles(shape, eyes, ways)
        is_box = self.radius[shape] == 0.0
        found = np.empty(len(shape))
        circle, box = np.flatnonzero(~is_box), np.flatnonzero(is_box)
        found[circle] = self._to_circles(shape[circle], eyes[circle], ways[circle])
        found[box] = self._to_boxes(shape[box], eyes[box], ways[box])
        return found

    def _to_circles(self, shape: NDArray[np.intp], eyes: Vectors, ways: Vectors) -> Floats:
        seen = (self.centre[shape] - eyes) * ways.conj()
        square = self.radius[shape] ** 2 - seen.imag**2
        along = np.sqrt(np.maximum(square, 0.0))
        misses = (square < 0.0) | (seen.real + along < 0.0)
        found: Floats = np.where(misses, np.inf, np.maximum(seen.real - along, 0.0))
        return found

    def _to_boxes(self, shape: NDArray[np.intp], eyes: Vectors, ways: Vectors) -> Floats:
        back = self.axis[shape].conj()
        eye, way = (eyes - self.centre[shape]) * back, ways * back
        places, steps = np.stack((eye.real, eye.imag)), np.stack((way.real, way.imag))
        steps = np.where(np.abs(steps) < _LEAST, _LEAST, steps)
        halves = self.halves[:, shape]
        one, other = (-halves - places) / steps, (halves - places) / steps
        enters, leaves = np.minimum(one, other).max(axis=0), np.maximum(one, other).min(axis=0)
        misses = (enters > leaves) | (leaves < 0.0) | (halves[0] == 0.0)
        found: Floats = np.where(misses, np.inf, np.maximum(enters, 0.0))
        return found
