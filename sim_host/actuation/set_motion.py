"""Drives that set the velocity of a body: each robot plans for itself, from the motion that was set last.

The measured motion differs from that one where something disturbed the robot, or holds it back.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Generic, NamedTuple, TypeVar

from schemas.config.ramp import Planar, Ramp, TurnRamp
from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.messages.command import Drive
from sim_host.actuation.drive_model import Bodies, DriveModel, Plan
from sim_host.actuation.stuck_detector import MIN_SPEED, MIN_TURN_RATE, SLOW_SHARE
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState, RobotStates

_UNDISTURBED = 1e-3
"""m/s and rad/s; a robot whose measured motion differs by no more from the set one was not disturbed."""


class Slip(NamedTuple):
    """By how much the measured motion of a disturbed robot differs from the one that was set."""

    moving: float
    """m/s; 0 where its velocity was not disturbed."""
    turning: float
    """rad/s; 0 where its turn rate was not."""

    def holds_back(self, robot: RobotState, wanted: Planar, wanted_turn: float) -> bool:
        """Whether the robot moves well below its demand, or turns well below it, if it is only to turn."""
        wanted_speed, wanted_turn = math.hypot(*wanted), abs(wanted_turn)
        if wanted_speed > MIN_SPEED:
            return self.moving > 0.0 and math.hypot(robot.vx, robot.vy) < SLOW_SHARE * wanted_speed
        return self.turning > 0.0 and wanted_turn > MIN_TURN_RATE and abs(robot.omega) < SLOW_SHARE * wanted_turn


def slip_of(last: FieldTwist, robot: RobotState) -> Slip | None:
    """How a robot that was set to this motion slips; None for one that was not disturbed."""
    vx, vy, omega = last
    moving, turning = math.hypot(vx - robot.vx, vy - robot.vy), abs(omega - robot.omega)
    if moving <= _UNDISTURBED and turning <= _UNDISTURBED:
        return None
    return Slip(moving if moving > _UNDISTURBED else 0.0, turning if turning > _UNDISTURBED else 0.0)


class SetMotion(ABC):
    """The drive of one robot, with its memory."""

    def __init__(self, time: TimeSteps, model: RobotModel) -> None:
        step, steps, drive = time.physics_step, time.steps_per_tick, model.drive
        self._ramp, self._turning = Ramp(drive, step, steps), TurnRamp(drive, step, steps)
        self.last: FieldTwist | None = None
        """The motion that was set last, in the field frame; None at the beginning."""
        self.held_back = False
        """At the beginning of the tick: the robot is disturbed, and moves well below its demand."""

    @abstractmethod
    def plan(self, robot: RobotState, demand: Drive) -> list[FieldTwist]:
        """The velocity in each step of a tick; updates `held_back`. The demand is in the body frame."""


One = TypeVar("One", bound=SetMotion)


class SetMotionDrive(DriveModel, Generic[One]):
    """The drives of some robots, each with its own memory."""

    one: type[One]
    """What each robot is driven by."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        self.robots = [self.one(time, model) for model in models]

    @property
    def held_back(self) -> Sequence[bool]:
        """Per robot, at the beginning of the tick: it is disturbed, and moves well below its demand."""
        return [robot.held_back for robot in self.robots]

    def reset(self) -> None:
        """Clear the memory: the next tick begins from the measured velocities."""
        for robot in self.robots:
            robot.last = None

    def plan(self, robots: RobotStates, demands: Sequence[Drive], _bodies: Bodies) -> Plan:
        """The velocities of one tick, per physics step and robot; `demands` are in the body frames."""
        plans = [drive.plan(robot, demand) for drive, robot, demand in zip(self.robots, robots, demands, strict=True)]
        return list(zip(*plans, strict=True))
