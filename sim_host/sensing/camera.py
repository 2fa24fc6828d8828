"""The cameras of all robots: one picture shows the ball and the obstacles that each robot sees at one tick."""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from schemas.config.sections import Sensing
from schemas.messages.percept import DIGITS
from schemas.messages.sight import Obstacle
from sim_host.sensing.digits import rounded
from sim_host.sensing.hulls import Hulls
from sim_host.sensing.pair_draws import pair_draws
from sim_host.sensing.random_streams import BatchedDraws, Floats, RandomStreams, StreamId, Vectors
from sim_host.sensing.shutter import Shutter
from sim_host.sensing.sight_lines import Flags
from sim_host.sensing.team_frames import TeamFrames
from sim_host.sensing.view import View
from sim_host.snapshot import BALL, BallState, ObstacleState, RobotMotions, Roster, Snapshot

_NO_DISTANCE = np.array(1e-9)
"""m; avoids a division by zero for the distance of a robot from itself, which is not used."""
_OUT_OF_RANGE = BallState(1e9, 0.0, 0.0, 0.0, 0.0, 0.0)
"""A ball that no camera sees stands for none."""
_LATER = 1e-9
"""m by which an opponent seems farther than a teammate; without it, equally far bodies would be in roster order."""


class Picture(NamedTuple):
    """The bodies that were found, in each robot's team frame as that robot believes it to lie."""

    tick: int
    """The tick at which it was taken."""
    ball: list[list[float]]
    """Per robot: x, y, z in m and vx, vy in m/s; meaningless where the ball was not found."""
    found: list[bool]
    """Per robot: whether the ball was found."""
    obstacles: list[list[Obstacle]]
    """Per robot: the obstacles, the nearest first."""

    @classmethod
    def nothing(cls, robots: int) -> "Picture":
        """An empty picture, for the time before the first one."""
        return cls(0, [], [False] * robots, [[] for _ in range(robots)])

    def for_robots(self, places: Sequence[int | None]) -> "Picture":
        """The same picture for other robots, by their indices in this one; a robot without an index sees nothing."""
        seen = [None if place is None or not self.ball else place for place in places]
        return Picture(
            self.tick,
            [[0.0] * 5 if place is None else self.ball[place] for place in seen],
            [place is not None and self.found[place] for place in seen],
            [[] if place is None else self.obstacles[place] for place in places],
        )

    def rotated(self) -> "Picture":
        """The same picture in team frames turned by π."""
        obstacles = [[Obstacle(x=-one.x, y=-one.y, radius=one.radius) for one in seen] for seen in self.obstacles]
        return Picture(self.tick, [rotated_ball(ball) for ball in self.ball], self.found, obstacles)


def rotated_ball(ball: list[float]) -> list[float]:
    """x, y, z, vx, vy in a frame turned by π."""
    x, y, z, vx, vy = ball
    return [-x, -y, z, -vx, -vy]


class Camera:
    """Takes pictures. Things are the ball and then the bodies, robots and obstacles. Arrays are robots × things."""

    def __init__(self, sensing: Sensing, roster: Roster, streams: RandomStreams, shutter: Shutter) -> None:
        self._sensing = sensing
        self._streams = streams
        self._shutter = shutter
        self._roster = roster
        self._growth = np.array([sensing.range_noise, sensing.bearing_noise])[:, None, None] ** 2
        self._ball_growth = np.array(sensing.ball_velocity_growth)
        self._ball_velocity = np.array(sensing.ball_velocity**2)
        self._ball_draws = BatchedDraws(self._draw_ball)
        self._prepare(())

    def _prepare(self, obstacles: tuple[ObstacleState, ...]) -> None:
        """Compute everything that is the same in all pictures of the same bodies."""
        s, roster = self._sensing, self._roster
        self._obstacles = obstacles
        self._hulls = Hulls(roster.models, obstacles)
        names = (BALL, *roster.names, *(one.name for one in obstacles))
        robots, bodies = len(roster.names), len(names) - 1
        self._near = np.array([s.ball_position] + [s.obstacle_position] * bodies) ** 2
        self._range = np.array([s.ball_range] + [s.obstacle_range] * bodies)
        self._is_other = np.arange(-1, bodies) != np.arange(robots)[:, None]
        self._draws = pair_draws(s, self._streams, self._shutter, roster.names, names)
        sides = [*roster.sides, *[None] * len(obstacles)]
        self._later = np.array([[_LATER * (its is not side) for its in sides] for side in roster.sides])
        """Per robot and body: m added to the distance, so that of two equally far bodies a teammate is first."""
        self._view = View.of([model.camera for model in roster.models])
        self._blur = np.empty((robots, 1 + bodies), dtype=complex)
        self._blur_parts = np.moveaxis(self._blur.view(float).reshape(robots, 1 + bodies, 2), 2, 0)
        self._ends = np.arange(1, robots + 1)
        self._radius = self._hulls.reach.round(DIGITS)

    def _set_obstacles(self, obstacles: tuple[ObstacleState, ...]) -> None:
        """Look for other obstacles; where the same ones have only moved, all but their hulls stays."""
        if [one.name for one in obstacles] == [one.name for one in self._obstacles]:
            self._obstacles, self._hulls = obstacles, Hulls(self._roster.models, obstacles)
            self._radius = self._hulls.reach.round(DIGITS)
        else:
            self._prepare(obstacles)

    def take_picture(self, snapshot: Snapshot, robots: RobotMotions, frames: TeamFrames) -> Picture:
        """Take a picture, in a tick in which one is due."""
        if snapshot.obstacles != self._obstacles:
            self._set_obstacles(snapshot.obstacles)
        number, ball = self._shutter.number(snapshot.tick), snapshot.ball_state or _OUT_OF_RANGE
        places = self._hulls.places(complex(ball.x, ball.y), robots.position) - robots.position[:, None]
        distance = np.abs(places)
        found: Flags = distance <= self._range
        found &= self._is_other
        if self._view is not None:
            found &= self._view.has(places, distance, robots.heading)
        if self._sensing.occlusion == "hulls":
            self._hulls.hide(found, places, distance, robots.heading, ball.z)
        self._blur_by(distance, self._draws.detect(number, found))
        blurred = places + places * self._blur
        seen = frames.turn[:, None] * blurred
        seen += (frames.sign * robots.position + frames.shift)[:, None]
        return Picture(
            tick=snapshot.tick,
            ball=self._ball(ball, seen[:, 0], distance[:, 0], frames.turn, self._ball_draws.at(number)),
            found=found[:, 0].tolist(),
            obstacles=self._nearest_first(np.abs(blurred[:, 1:]), seen[:, 1:], found[:, 1:]),
        )

    def _blur_by(self, distance: Floats, draws: Floats) -> None:
        """Set the noise along and across the line of sight, as a share of the distance: along + i·across."""
        share = self._growth * distance
        share *= distance
        share += self._near
        np.sqrt(share, out=share)
        share /= distance + _NO_DISTANCE
        np.multiply(share, draws, out=self._blur_parts)

    def _ball(
        self, ball: BallState, place: Vectors, distance: Floats, turn: Vectors, draws: Floats
    ) -> list[list[float]]:
        """The ball as each robot sees it: its place, its height and velocity with their noise."""
        sigma = self._ball_growth * distance
        sigma *= sigma
        sigma += self._ball_velocity
        np.sqrt(sigma, out=sigma)
        velocity = turn * complex(ball.vx, ball.vy)
        seen = np.empty((5, len(place)))
        seen[0], seen[1] = place.real, place.imag
        np.add(draws[0], ball.z, out=seen[2])
        np.multiply(draws[1:], sigma, out=seen[3:])
        seen[3] += velocity.real
        seen[4] += velocity.imag
        numbers: list[list[float]] = rounded(seen.T).tolist()
        return numbers

    def _nearest_first(self, away: Floats, places: Vectors, found: Flags) -> list[list[Obstacle]]:
        """The bodies that were found, in the order of their distance, which does not reveal their names."""
        robot, body = found.nonzero()
        order = np.lexsort(((away + self._later)[found], robot))
        place = places[found].take(order)
        x, y = rounded(place.real).tolist(), rounded(place.imag).tolist()
        bodies = list(map(Obstacle, x, y, self._radius.take(body.take(order)).tolist()))
        ends = robot.searchsorted(self._ends).tolist()
        return [bodies[start:end] for start, end in pairwise((0, *ends))]

    def _ticks(self, numbers: range) -> list[int]:
        return [self._shutter.tick_of(number) for number in numbers]

    def _draw_ball(self, numbers: range) -> list[Floats]:
        """Per picture, (3, robots): noise of the ball's height in m, and of vx and vy in units of their deviation.

        The ball has noise in these whenever it has noise in its place.
        """
        ticks, s = self._ticks(numbers), self._streams
        robots = self._roster.names
        is_noisy = s.pairwise_uniforms(StreamId.SEEN, robots, (BALL,), ticks)[:, :, 0, 3:] < self._sensing.noise_rate
        noise = np.ascontiguousarray(np.moveaxis(s.normals(StreamId.BALL, robots, ticks, 3) * is_noisy, 2, 1))
        noise[:, 0] *= self._sensing.ball_position
        return list(noise)
