"""What every drive model is: a class that plans the motions of some robots, tick by tick."""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from typing import ClassVar, NamedTuple

from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.messages.command import Drive
from sim_host.physics.engine import Engine
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState, RobotStates

Plan = Iterable[Sequence[FieldTwist]]
"""Velocities per physics step and robot; iterated to each step when it begins."""


class Bodies(NamedTuple):
    """The bodies of a drive's robots in the engine, for drives that look at them between two physics steps."""

    engine: Engine
    indices: Sequence[int]
    """Per robot of the drive: its index in the roster."""
    touching: Sequence[int]
    """Indices in the roster of robots that may touch another body in this tick; of those whose drive yields."""

    def now(self) -> list[RobotState]:
        """The states of the drive's robots between two steps."""
        return [self.engine.robot_now(index) for index in self.indices]


class DriveModel(ABC):
    """The drives of some robots, in the order in which their models are given."""

    yields: ClassVar[bool] = False
    """The drive plans a whole tick, and asks which robots may touch something: they yield to what is stronger."""

    @property
    @abstractmethod
    def held_back(self) -> Sequence[bool]:
        """Per robot, at the beginning of the tick that was planned last: it moves well below its demand."""

    @abstractmethod
    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None: ...

    @abstractmethod
    def reset(self) -> None:
        """Clear the memory: the next tick begins from the measured velocities."""

    @abstractmethod
    def plan(self, robots: RobotStates, demands: Sequence[Drive], bodies: Bodies) -> Plan:
        """The velocities of one tick in the field frame; `demands` are in the body frames."""

    def possible(self, demands: Sequence[Drive]) -> Sequence[Drive]:
        """The demands without what no robot of this drive can do, against which the progress of robots is compared."""
        return demands
