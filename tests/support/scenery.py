"""Worlds to perceive, and what is perceived of them by names instead of places."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any, NamedTuple

from schemas.config.noise import PERFECT
from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.config.sections import Sensing
from schemas.messages.percept import Percept
from schemas.side import Side
from sim_host.sensing.perception import Perception
from sim_host.sensing.random_streams import RandomStreams
from sim_host.snapshot import BallState, ObstacleState, RobotState, RobotStates, Roster, Snapshot

TICK = 0.02
Place = tuple[float, ...]


class Seen(NamedTuple):
    """A percept whose obstacles are triples."""

    own: list[float]
    ball: list[float] | None
    ball_age: float
    visible: bool
    obstacles: list[tuple[float, float, float]]
    obstacles_age: float


def seen_of(percept: Percept) -> Seen:
    obstacles = [(one.x, one.y, one.radius) for one in percept.obstacles]
    return Seen(*percept[:4], obstacles, percept.obstacles_age)


def roster_of(cyan: int, magenta: int) -> Roster:
    """Standard robots of `msl`; a side may have none."""
    names = [
        f"{side.value}{number + 1}" for side, size in zip(Side, (cyan, magenta), strict=True) for number in range(size)
    ]
    sides = tuple(Side(name.rstrip("0123456789")) for name in names)
    return Roster(tuple(names), sides, {}, (RobotModel.standard(load_profile("msl")),) * len(names))


class Scenery:
    """Robots, cyan's first, and a ball on the pitch, and what everybody perceives there, tick after tick."""

    def __init__(self, robots: Iterable[Place], ball: Place, cyan: int | None = None, **sensing: Any) -> None:
        """Robots as x, y, heading, vx, vy, omega, the ball as x, y, z, vx, vy; what is left out is 0.

        `sensing`: fields of `Sensing` in place of perfect perception; `sensing` itself, a whole one; `seed`; `roster`.
        """
        self.robots = [RobotState(*_filled(r[:2], 2), 0.4, *_filled(r[2:], 4), False) for r in robots]
        self.ball = BallState(*_filled(ball, 5), 0.0)
        count = len(self.robots)
        cyan = count if cyan is None else cyan
        self.roster = sensing.pop("roster", None) or roster_of(cyan, count - cyan)
        whole: Sensing = sensing.pop("sensing", PERFECT)
        streams = RandomStreams(sensing.pop("seed", 1))
        self.attacks = 1
        self.obstacles: tuple[ObstacleState, ...] = ()
        self.tick = 0
        self.perception = Perception(replace(whole, **sensing), self.roster, streams, TICK)

    def look(self) -> list[Seen]:
        """Everybody's percept of the next tick."""
        bodies = self.roster, RobotStates(self.robots), self.ball
        snapshot = Snapshot(self.tick, self.tick * TICK, *bodies, None, (), obstacles=self.obstacles)
        self.tick += 1
        return [seen_of(percept) for percept in self.perception.at(snapshot, self.attacks)]

    def move(self, place: int, x: float, y: float) -> None:
        """Set a robot down elsewhere."""
        self.robots[place] = self.robots[place]._replace(x=x, y=y)


def _filled(numbers: Iterable[float], count: int) -> list[float]:
    return [*numbers, 0.0, 0.0, 0.0, 0.0, 0.0][:count]
