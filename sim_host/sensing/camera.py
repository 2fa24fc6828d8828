"""One picture: what the cameras of all robots find of the ball and of what stands in the way, at one tick."""

from typing import NamedTuple

import numpy as np

from schemas.profile import Sensing
from sim_host.sensing.shutter import Shutter
from sim_host.sensing.sight_lines import Flags, hidden
from sim_host.sensing.streams import Block, Floats, Streams, What, normal_pairs
from sim_host.snapshot import BallState, Roster, Snapshot

_BALL = "ball"
"""No robot has this name."""
_NO_DISTANCE = 1e-9
"""m; in what direction from itself a robot is, nobody asks."""
PER_OBSTACLE = 3
"""Numbers that a picture has of each obstacle."""


class Picture(NamedTuple):
    """What was found, in each robot's team frame as that robot believes it to lie."""

    tick: int
    """When it was taken."""
    ball: list[list[float]]
    """Per robot: x, y, z in m and vx, vy in m/s; meaningless where it was not found."""
    found: list[bool]
    """Per robot: whether the ball was."""
    obstacles: list[list[float]]
    """Per robot: x, y, radius in m of each obstacle, one after the other, the nearest first."""

    @classmethod
    def nothing(cls, robots: int) -> "Picture":
        """What is known before the first picture."""
        return cls(0, [], [False] * robots, [[] for _ in range(robots)])

    def turned(self) -> "Picture":
        """The same picture in team frames that have turned by π since."""
        obstacles = [
            [-number if place % PER_OBSTACLE < 2 else number for place, number in enumerate(numbers)]
            for numbers in self.obstacles
        ]
        return Picture(self.tick, [turned_ball(ball) for ball in self.ball], self.found, obstacles)


def turned_ball(ball: list[float]) -> list[float]:
    """x, y, z, vx, vy in a frame that has turned by π."""
    x, y, z, vx, vy = ball
    return [-x, -y, z, -vx, -vy]


class Camera:
    """Things are the ball and then the bodies: the robots. Arrays are robots × things."""

    def __init__(self, sensing: Sensing, roster: Roster, streams: Streams, shutter: Shutter) -> None:
        self._sensing = s = sensing
        self._streams = streams
        self._shutter = shutter
        self._names = roster.names
        self._radius = np.array([model.body.radius for model in roster.models])
        self._height = height = np.array([model.body.height for model in roster.models])
        robots, bodies = np.arange(len(roster.names)), np.arange(len(height))
        self._rows = robots[:, None]
        self._near = np.array([s.ball_position] + [s.obstacle_position] * len(bodies)) ** 2
        self._growth = np.array([s.range_noise, s.bearing_noise])[:, None, None]
        self._range = np.array([s.ball_range] + [s.obstacle_range] * len(bodies))
        self._dropout = np.array([s.ball_dropout] + [s.obstacle_dropout] * len(bodies))
        self._is_other = np.ones((len(robots), len(bodies) + 1), dtype=bool)
        self._is_other[robots, robots + 1] = False
        self._is_tall = np.empty((len(bodies), len(robots), len(bodies) + 1), dtype=bool)
        """Hull × eye × thing: whether it is high enough to hide it; the ball's part changes with the ball's height."""
        self._is_tall[:, :, 1:] = (height[:, None] >= height)[:, None, :]
        self._is_tall[bodies, :, bodies + 1] = False
        self._luck = Block(self._draw)
        self._ball_luck = Block(self._draw_ball)

    def take(self, snapshot: Snapshot, robots: Floats, frame: Floats) -> Picture:
        """A picture, in a tick in which one is taken.

        `robots`: their states in the field frame, one column each; `frame`: as `Perception` makes it.
        """
        number = self._shutter.number(snapshot.tick)
        luck = self._luck.at(number)
        eyes = robots[:2]
        bodies = np.concatenate((np.array(snapshot.ball[:2])[:, None], eyes), axis=1)
        places = bodies[:, None, :] - eyes[:, :, None]
        square = places[0] * places[0] + places[1] * places[1]
        distance = np.sqrt(square)
        found = self._find(places, square, distance, snapshot.ball.z)
        found &= luck[2] >= self._dropout
        x, y = self._blurred(places, square, distance, luck)
        sign, dx, dy, _, c, s = frame[:, :, None]
        seen_x = c * x - s * y + (sign * eyes[0][:, None] + dx)
        seen_y = s * x + c * y + (sign * eyes[1][:, None] + dy)
        away = np.where(found, x * x + y * y, np.inf)
        return Picture(
            tick=snapshot.tick,
            ball=self._ball(snapshot.ball, seen_x[:, 0], seen_y[:, 0], square[:, 0], frame, self._ball_luck.at(number)),
            found=found[:, 0].tolist(),
            obstacles=self._nearest_first(away[:, 1:], seen_x[:, 1:], seen_y[:, 1:], found[:, 1:]),
        )

    def _find(self, places: Floats, square: Floats, distance: Floats, ball_height: float) -> Flags:
        """What is near enough and not hidden; nobody sees itself."""
        found: Flags = distance <= self._range
        found &= self._is_other
        if self._sensing.occlusion == "hulls":
            self._is_tall[:, :, 0] = (self._height >= ball_height)[:, None]
            found &= ~hidden(places, square, self._radius, self._is_tall)
        return found

    def _blurred(self, places: Floats, square: Floats, distance: Floats, luck: Floats) -> Floats:
        """Places as seen from the eyes, with noise along the line of sight and across it."""
        share = luck[:2] * np.sqrt(self._near + self._growth * self._growth * square) / (distance + _NO_DISTANCE)
        along, across = 1.0 + share[0], share[1]
        x, y = places
        return np.stack((x * along - y * across, y * along + x * across))

    def _ball(
        self, ball: BallState, x: Floats, y: Floats, square: Floats, frame: Floats, luck: Floats
    ) -> list[list[float]]:
        """The ball of each robot that sees it at (x, y): with its height and velocity, and their noise."""
        s = self._sensing
        velocity = np.sqrt(s.ball_velocity**2 + s.ball_velocity_growth**2 * square)
        _, _, _, _, cosine, sine = frame
        seen = np.empty((5, len(x)))
        seen[0], seen[1], seen[2] = x, y, ball.z + luck[0] * s.ball_position
        seen[3] = cosine * ball.vx - sine * ball.vy + luck[1] * velocity
        seen[4] = sine * ball.vx + cosine * ball.vy + luck[2] * velocity
        numbers: list[list[float]] = seen.T.tolist()
        return numbers

    def _nearest_first(self, square: Floats, x: Floats, y: Floats, found: Flags) -> list[list[float]]:
        """The bodies that were found, in the order of their square distance: it tells nobody's name."""
        order = square.argsort(axis=1, kind="stable")
        numbers = np.empty((*square.shape, PER_OBSTACLE))
        numbers[..., 0], numbers[..., 1], numbers[..., 2] = x, y, self._radius
        rows = numbers[self._rows, order].reshape(len(square), -1).tolist()
        counts = found.sum(axis=1).tolist()
        return [row[: PER_OBSTACLE * count] for row, count in zip(rows, counts, strict=True)]

    def _ticks(self, numbers: range) -> list[int]:
        return [self._shutter.tick_of(number) for number in numbers]

    def _draw(self, numbers: range) -> Floats:
        """Per picture: noise along and across the line of sight, and luck against dropouts; (3, robots, things)."""
        drawn = self._streams.between(What.SEEN, self._names, (_BALL, *self._names), self._ticks(numbers))
        noise = normal_pairs(drawn[..., :2]) * (drawn[..., 3:] < self._sensing.noise_rate)
        return np.ascontiguousarray(np.moveaxis(np.concatenate((noise, drawn[..., 2:3]), axis=-1), -1, 1))

    def _draw_ball(self, numbers: range) -> Floats:
        """Per picture: noise of the ball's height, vx and vy, noisy when its place is; (3, robots)."""
        ticks, s = self._ticks(numbers), self._streams
        is_noisy = s.between(What.SEEN, self._names, (_BALL,), ticks)[:, :, 0, 3:] < self._sensing.noise_rate
        return np.ascontiguousarray(np.moveaxis(s.normals(What.BALL, self._names, ticks, 3) * is_noisy, 2, 1))
