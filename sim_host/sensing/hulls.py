"""The hulls of robots and obstacles, seen from above as circles and boxes, and the things that they hide."""

from bisect import bisect_left
from collections.abc import Sequence

import numpy as np

from schemas.config.obstacle import Shape
from schemas.config.robot_model import RobotModel
from sim_host.sensing.random_streams import Floats, Vectors
from sim_host.sensing.shadows import hulls_near_lines
from sim_host.sensing.sight_lines import Flags, Indices, through_boxes, through_circles
from sim_host.snapshot import ObstacleState

MANY_HULLS = 42
"""From this number on, it costs less to find the hulls near each line of sight than to try all of them; with few, four
times as much."""


class Hulls:
    """Bodies are the robots and then the obstacles; things are the ball and then the bodies."""

    def __init__(self, models: Sequence[RobotModel], obstacles: Sequence[ObstacleState]) -> None:
        robots = [model.body for model in models]
        self.reach = np.array([body.reach for body in robots] + [one.radius for one in obstacles])
        """Radius of the circle around each body, m."""
        self._height = np.array([body.height for body in robots] + [one.height for one in obstacles])
        is_round = [1.0] * len(robots) + [float(one.shape is Shape.CYLINDER) for one in obstacles]
        radius = [body.radius for body in robots] + [one.radius for one in obstacles]
        self._radius = np.array(radius) * is_round
        self._places = np.zeros(1 + len(robots) + len(obstacles), dtype=complex)
        self._places[1 + len(robots) :] = [complex(one.x, one.y) for one in obstacles]
        self._headings = np.array([one.heading for one in obstacles])
        self._lay_out_boxes(models, obstacles)
        self._lay_out_heights(len(robots))

    def _lay_out_boxes(self, models: Sequence[RobotModel], obstacles: Sequence[ObstacleState]) -> None:
        """Boxes of frames and square obstacles: owner, distance ahead of the owner's centre, half depth and width."""
        boxes = [
            (place, model.body.radius - model.body.frame_depth / 2, model.body.frame_depth, model.body.frame_width)
            for place, model in enumerate(models)
            if model.body.frame_width
        ]
        boxes += [
            (len(models) + place, 0.0, one.size_x, one.size_y)
            for place, one in enumerate(obstacles)
            if one.shape is Shape.BOX
        ]
        numbers = np.array(boxes).reshape(-1, 4).T
        self._owner, self._ahead, self._halves = numbers[0].astype(int), numbers[1], numbers[2:] / 2.0
        self._box = np.full(len(self._height), -1)
        self._box[self._owner] = np.arange(len(boxes))
        """Body → its box, or -1."""

    def _lay_out_heights(self, eyes: int) -> None:
        """Hull × thing: whether the hull is another body, and high enough to hide the thing."""
        bodies = np.arange(len(self._height))
        self._is_tall = np.concatenate((self._height[:, None] > 0.0, self._height[:, None] >= self._height), axis=1)
        self._is_tall[bodies, bodies + 1] = False
        if len(bodies) < MANY_HULLS:
            self._is_others = bodies[:, None] != np.arange(eyes)
            self._may_hide = self._is_tall[:, None, :] & self._is_others[:, :, None]
            """Hull × eye × thing: whether also the hull is not the eye's own."""
        self._sorted_heights: list[float] = sorted(self._height.tolist())
        self._lower: int | None = None
        """Number of hulls that are lower than the ball, and cannot hide it; None before the first picture."""

    def _update_ball_height(self, height: float) -> None:
        """Update which hulls are high enough to hide a ball at this height; they rarely change."""
        lower = bisect_left(self._sorted_heights, height)
        if lower != self._lower:
            self._lower = lower
            self._is_tall[:, 0] = self._height >= height
            if len(self._height) < MANY_HULLS:
                self._may_hide[:, :, 0] = self._is_tall[:, :1] & self._is_others

    def places(self, ball: complex, robots: Vectors) -> Vectors:
        """The places of all things, m, for these places of ball and robots; valid until the next call."""
        places = self._places
        places[0], places[1 : 1 + len(robots)] = ball, robots
        return places

    def hide(self, found: Flags, places: Vectors, distance: Floats, headings: Floats, ball_height: float) -> None:
        """Remove hidden things from those that each robot would find without hulls.

        `places` of the things as seen from each robot, m, shape (robots, things), and their `distance`. A thing is
        hidden when the line to its centre passes through a hull that is at least as high and not farther away.
        """
        self._update_ball_height(ball_height)
        turned = np.exp(1j * np.concatenate((headings, self._headings))[self._owner]) if len(self._owner) else _NONE
        if len(self._height) < MANY_HULLS:
            found &= ~self._hidden_by_any(places, distance, turned)
        else:
            found[found] = ~self._hidden_in_shadows(np.flatnonzero(found), places, distance, turned)

    def _hidden_by_any(self, places: Vectors, distance: Floats, turned: Vectors) -> Flags:
        """Which things are hidden from which robots, by a trial of all hulls; `turned` are the boxes' headings."""
        hulls, (eyes, things) = len(self._height), places.shape
        lines = places[:, 1:].T.repeat(things, axis=1)
        np.conjugate(lines, out=lines)
        lines *= places.reshape(-1)
        hides = through_circles(lines, distance.reshape(-1), self._radius[:, None]).reshape(hulls, eyes, things)
        hides &= self._may_hide
        found: Flags = np.logical_or.reduce(hides, axis=0)
        if len(self._owner):
            centres = places[:, 1:][:, self._owner].T + (self._ahead * turned)[:, None]
            shape = (-1, 1, 1)
            hides = through_boxes(places, centres[..., None], turned.reshape(shape), self._halves.reshape(2, *shape))
            hides &= self._may_hide[self._owner]
            found |= np.logical_or.reduce(hides, axis=0)
        return found

    def _hidden_in_shadows(self, pairs: Indices, places: Vectors, distance: Floats, turned: Vectors) -> Flags:
        """Which of these pairs are hidden, by a trial of the hulls that are near their lines of sight."""
        near = hulls_near_lines(pairs, places, distance, self.reach)
        hull, pair = near.hull, pairs.take(near.line)
        thing = pair % places.shape[1]
        place, centre = places.reshape(-1).take(pair), places.reshape(-1).take(pair - thing + 1 + hull)
        hides = through_circles(centre.conj() * place, distance.reshape(-1).take(pair), self._radius.take(hull))
        with_box = np.flatnonzero(self._box.take(hull) >= 0)
        if len(with_box):
            box = self._box.take(hull.take(with_box))
            centres = centre.take(with_box) + (self._ahead * turned).take(box)
            halves = self._halves.take(box, axis=1)
            hides[with_box] |= through_boxes(place.take(with_box), centres, turned.take(box), halves)
        hides &= self._is_tall[hull, thing]
        found = np.zeros(len(pairs), dtype=bool)
        found[near.line.compress(hides)] = True
        return found


_NONE = np.empty(0, dtype=complex)
