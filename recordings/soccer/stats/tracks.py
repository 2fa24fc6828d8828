"""Positions of all bodies, sampled and rounded, so that a page with them stays small."""

import math
from array import array

from recordings.soccer.stats.match_tick import MatchTick
from schemas.messages.setup import Setup
from schemas.messages.world import World

MAX_RATE = 25.0
"""Samples per s; the page interpolates between them, and more would not be visible. Chosen here."""
MIN_RATE = 0.1
MAX_BYTES = 3_300_000
"""Bytes of all samples. In base64 they take a third more; a page of half an hour stays below 6 MB. Chosen here."""
ABSENT = -32768
"""Value of x for a body that is absent."""
NO_HOLDER = 255
_CM = 100.0
_TURN = 256 / math.tau
_PER_ROBOT, _PER_SAMPLE = 5, 7
"""Bytes. A robot: x and y two each, heading one. The rest of a sample: x, y and z of the ball two each, holder one."""


def sample_rate(duration: float, robots: int) -> float:
    """Samples per s for a recording of this duration, in s, and number of robots."""
    per_sample = _PER_SAMPLE + _PER_ROBOT * robots
    return max(MIN_RATE, min(MAX_RATE, MAX_BYTES / per_sample / max(duration, 1.0)))


class RobotTrack:
    """Samples of one robot: x and y in cm, heading in 1/256 of a turn."""

    def __init__(self, samples: int) -> None:
        """The robot is absent from the first `samples` samples."""
        self.x = array("h", [ABSENT] * samples)
        self.y = array("h", [0] * samples)
        self.heading = array("B", [0] * samples)

    def add(self, x: int, y: int, heading: int) -> None:
        """Add a sample."""
        self.x.append(x)
        self.y.append(y)
        self.heading.append(heading)


class Tracks:
    """Samples of all bodies at equal intervals: sample i is the newest world at the time `start + i / rate`."""

    def __init__(self, setup: Setup, start: float, end: float) -> None:
        """`start` and `end` are in s of simulated time."""
        self.start = start
        self.rate = sample_rate(end - start, sum(len(team.robots) for team in setup.teams.values()))
        self.robots: dict[str, RobotTrack] = {}
        self.ball_x, self.ball_y, self.ball_z = array("h"), array("h"), array("h")
        self.holder = array("B")
        """Index in `robots` of the robot that holds the ball, or `NO_HOLDER`."""
        self.sides: dict[str, str] = {}
        self._tick = setup.time.tick
        self._newest: World | None = None

    @property
    def samples(self) -> int:
        """Number of samples so far."""
        return len(self.holder)

    def update(self, match_tick: MatchTick) -> None:
        """Add a tick."""
        for robot in match_tick.lineup.robots.values():
            self.sides[robot.name] = robot.side.value
        world = match_tick.world
        while self._time() < world.time - self._tick / 2:
            self._sample(self._newest or world)
        if self._time() <= world.time + self._tick / 2:
            self._sample(world)
        self._newest = world

    def _time(self) -> float:
        """Time of the next sample, in s of simulated time."""
        return self.start + self.samples / self.rate

    def _sample(self, world: World) -> None:
        for name in world.robots:
            if name not in self.robots:
                self.robots[name] = RobotTrack(self.samples)
        for name, track in self.robots.items():
            robot = world.robots.get(name)
            if robot is None:
                track.add(ABSENT, 0, 0)
            else:
                track.add(_cm(robot.x), _cm(robot.y), round(robot.heading * _TURN) & 255)
        ball, names = world.match_ball, list(self.robots)
        self.ball_x.append(_cm(ball.x))
        self.ball_y.append(_cm(ball.y))
        self.ball_z.append(_cm(ball.z))
        holder = names.index(world.possession) if world.possession in self.robots else NO_HOLDER
        self.holder.append(min(NO_HOLDER, holder))


def _cm(metres: float) -> int:
    return max(-32767, min(32767, round(metres * _CM)))
