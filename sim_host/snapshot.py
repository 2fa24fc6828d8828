"""The state of the world at one tick, as plain numbers in the field frame: what the referee and the sensors look at."""

from dataclasses import dataclass, replace
from typing import NamedTuple

from schemas.match_config import MatchConfig
from schemas.profile import Profile
from schemas.robot_model import RobotModel
from schemas.side import Side


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


class BallState(NamedTuple):
    """The ball: centre in m, velocity in m/s."""

    x: float
    y: float
    z: float
    vx: float
    vy: float
    vz: float


@dataclass(frozen=True, slots=True)
class Roster:
    """Who takes part, in one fixed order that every array and tuple of robots follows."""

    names: tuple[str, ...]
    sides: tuple[Side, ...]
    keepers: dict[Side, str]
    models: tuple[RobotModel, ...]

    @classmethod
    def of(cls, config: MatchConfig, profile: Profile) -> "Roster":
        """The robots of a match: cyan's, then magenta's, each side's goalkeeper first."""
        members = [(name, side) for side in Side for name in config.robots(side)]
        return cls(
            names=tuple(name for name, _ in members),
            sides=tuple(side for _, side in members),
            keepers={side: config.robots(side)[0] for side in Side},
            models=(RobotModel.standard(profile),) * len(members),
        )

    def tuned(self, profile: Profile) -> "Roster":
        """The same robots with the numbers of a profile."""
        return replace(self, models=(RobotModel.standard(profile),) * len(self.names))

    def side_of(self, name: str) -> Side:
        """The side of a robot."""
        return self.sides[self.names.index(name)]


@dataclass(frozen=True, slots=True)
class Snapshot:
    """Everything there is on the field at one tick; `robots` in the order of the roster."""

    tick: int
    time: float
    roster: Roster
    robots: tuple[RobotState, ...]
    ball: BallState
    possession: str | None
    """The robot that holds the ball."""
    touches: tuple[str, ...]
    """Robots that touched, held or kicked the ball since the tick before, in order of time, from contacts and kicks."""
    kicked: str | None = None
    """The robot whose kick was carried out in this tick."""
