"""The state of the world at one tick, as plain numbers in the field frame: the input of the referee and the sensors."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from schemas.config.match_config import MatchConfig
from schemas.config.obstacle import ObstacleConfig, Shape
from schemas.config.profile import Profile
from schemas.config.robot_model import RobotModel, models_of
from schemas.config.roster import RosterEntry
from schemas.errors import NoBallError
from schemas.frames import Pose
from schemas.side import Side

BALL = "ball"
"""Name of the ball among bodies; no robot and no obstacle has it."""


class RobotState(NamedTuple):
    """One robot: centre in m, heading in rad, velocities in m/s and rad/s."""

    x: float
    y: float
    z: float
    heading: float
    vx: float
    vy: float
    omega: float
    holding: bool


_ROBOT_NUMBERS = len(RobotState._fields)


class RobotMotions(NamedTuple):
    """The true motions of all robots, in the field frame, in the order of the roster."""

    position: NDArray[np.complex128]
    """m."""
    heading: NDArray[np.float64]
    """rad."""
    velocity: NDArray[np.complex128]
    """m/s."""
    omega: NDArray[np.float64]
    """rad/s."""

    @classmethod
    def of(cls, robots: Sequence[RobotState]) -> Self:
        """The motions of these robots."""
        numbers = np.fromiter(chain.from_iterable(robots), float, _ROBOT_NUMBERS * len(robots))
        position, height_heading, velocity, omega_holding = numbers.view(complex).reshape(-1, _ROBOT_NUMBERS // 2).T
        return cls(position, height_heading.imag, velocity, omega_holding.real)


class RobotStates(tuple[RobotState, ...]):
    """All robots, in the order of the roster."""

    @cached_property
    def motions(self) -> RobotMotions:
        """The same as arrays, made once and shared by all users, which must not change them."""
        return RobotMotions.of(self)


class Impact(NamedTuple):
    """Two robots that have hit each other, by their indices in the roster, the smaller index first."""

    first: int
    second: int
    direction: tuple[float, float]
    """Unit vector from the first to the second, across the place where they touch."""
    first_velocity: tuple[float, float]
    """m/s before the impact."""
    second_velocity: tuple[float, float]
    """m/s before the impact."""

    @property
    def first_speed(self) -> float:
        """m/s at which the first drove toward the second; negative if it drove away."""
        return self.first_velocity[0] * self.direction[0] + self.first_velocity[1] * self.direction[1]

    @property
    def second_speed(self) -> float:
        """m/s at which the second drove toward the first; negative if it drove away."""
        return -self.second_velocity[0] * self.direction[0] - self.second_velocity[1] * self.direction[1]

    @property
    def closing_speed(self) -> float:
        """m/s at which they approached each other."""
        return self.first_speed + self.second_speed


class BallState(NamedTuple):
    """The ball: centre in m, velocity in m/s."""

    x: float
    y: float
    z: float
    vx: float
    vy: float
    vz: float


class Pushed(NamedTuple):
    """What an obstacle that can be pushed has besides its place."""

    vx: float
    """m/s."""
    vy: float
    """m/s."""
    omega: float
    """rad/s."""
    mass: float
    """kg."""
    friction: float
    """Coefficient of friction on the ground."""


class ObstacleState(NamedTuple):
    """An obstacle: centre in m, heading in rad."""

    name: str
    x: float
    y: float
    heading: float
    radius: float
    """m; of the smallest circle around it on the ground; for a cylinder, its own radius."""
    height: float
    """m above the ground."""
    shape: Shape
    size_x: float
    """m; of the box along its heading; a cylinder's diameter."""
    size_y: float
    """m; of the box across; a cylinder's diameter."""
    pushed: Pushed | None = None
    """None for an obstacle that stands fast."""

    @property
    def is_round(self) -> bool:
        """It is a cylinder."""
        return self.shape is Shape.CYLINDER

    @classmethod
    def of(cls, obstacle: ObstacleConfig) -> "ObstacleState":
        """The state of an obstacle."""
        (x, y), (size_x, size_y, height) = obstacle.place, obstacle.extents
        mass, at_rest = obstacle.mass, (0.0, 0.0, 0.0)
        pushed = Pushed(*at_rest, mass, obstacle.floor_friction) if mass is not None else None
        shape, sizes = obstacle.shape, (size_x, size_y)
        return cls(obstacle.name, x, y, obstacle.heading, obstacle.reach, height, shape, *sizes, pushed)


@dataclass(frozen=True, slots=True)
class Roster:
    """The robots that take part, in one fixed order that every array and tuple of robots follows."""

    names: tuple[str, ...]
    sides: tuple[Side, ...]
    keepers: dict[Side, str]
    models: tuple[RobotModel, ...]
    still: tuple[str, ...] = ()
    """Robots that no agent moves."""

    @classmethod
    def of(cls, config: MatchConfig, profile: Profile) -> "Roster":
        """The robots of a match: cyan's, then magenta's, each side's goalkeeper first.

        Raises:
            TouchlineError: a robot has an unknown type, or a type has an invalid number.
        """
        members, models = [(name, side) for side in Side for name in config.robots(side)], models_of(config, profile)
        return cls(
            names=tuple(name for name, _ in members),
            sides=tuple(side for _, side in members),
            keepers={side: config.robots(side)[0] for side in Side},
            models=tuple(models[name] for name, _ in members),
        )

    @classmethod
    def of_entries(cls, robots: Sequence[RosterEntry], types: Mapping[str, RobotModel]) -> "Roster":
        """A roster of these robots, in this order, with the models of their types."""
        return cls(
            names=tuple(entry.name for entry in robots),
            sides=tuple(entry.side for entry in robots),
            keepers={entry.side: entry.name for entry in robots if entry.keeper},
            models=tuple(types[entry.type] for entry in robots),
            still=tuple(entry.name for entry in robots if not entry.agent),
        )

    def side_of(self, name: str) -> Side:
        """The side of a robot."""
        return self.sides[self.names.index(name)]


@dataclass(frozen=True, slots=True)
class Snapshot:
    """The state of everything on the field at one tick; `robots` in the order of the roster."""

    tick: int
    time: float
    roster: Roster
    robots: RobotStates
    ball_state: BallState | None
    """The ball; None in a game without one."""
    possession: str | None
    """The robot that holds the ball."""
    touches: tuple[str, ...]
    """Robots that touched, held or kicked the ball since the tick before, each once, in order of their last touch.

    A touch in a later physics step is later, and within a step the touch of the robot that presses harder."""
    level: tuple[str, ...] = ()
    """The last robots of `touches`, if several were equally late and pressed equally hard: none of them is the last."""
    kicked: str | None = None
    """The robot whose kick was carried out in this tick."""
    silent: tuple[str, ...] = ()
    """Robots whose agent is gone or does not answer, in the order of the roster."""
    refbox: bool = False
    """A league's referee box is connected."""
    contacts: tuple[tuple[int, int], ...] = ()
    """Pairs of robots that touch each other, by their indices in the roster, sorted, the smaller index first."""
    impacts: tuple[Impact, ...] = ()
    """Robots that have hit each other since the tick before, in the order of the roster."""
    ball_spin: tuple[float, float] = (0.0, 0.0)
    """rad/s; the ball's spin about the field's x and y. A rolling ball has the spin (−vy, vx) / radius."""
    obstacles: tuple[ObstacleState, ...] = ()
    """Obstacles, in the order in which they were added."""
    kickers_ready: tuple[bool, ...] = ()
    """Per robot: its kicker is charged."""

    @property
    def ball(self) -> BallState:
        """The ball.

        Raises:
            NoBallError: the game has none.
        """
        if self.ball_state is None:
            raise NoBallError
        return self.ball_state

    def with_robot_at(self, name: str, pose: Pose) -> "Snapshot":
        """The same snapshot with a robot at another pose."""
        index = self.roster.names.index(name)
        moved = self.robots[index]._replace(x=pose.x, y=pose.y, heading=pose.heading)
        return replace(self, robots=RobotStates((*self.robots[:index], moved, *self.robots[index + 1 :])))
