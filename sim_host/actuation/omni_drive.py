"""The drive model `omni`: wheels follow the planned velocity as far as motors and grip allow.

The robot's controller plans as the drive model `velocity` does, but from its last plan, not from the measured motion: a
robot that is held back goes on pushing. The body keeps the engine's velocity, to which each physics step adds the
change by the wheels' forces.
"""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from schemas.config.ramp import Ramp, TurnRamp
from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.frames import rotate, to_body
from schemas.messages.command import Drive
from sim_host.actuation.drive_model import Bodies, DriveModel, Plan
from sim_host.actuation.stuck_detector import MIN_SPEED, MIN_TURN_RATE, SLOW_SHARE
from sim_host.actuation.wheels import Floats, WheelSets
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState

_SAME_SPEED = 1e-9
"""m/s; a plan this near to the demand is set to the demand, so that wheels that shall rest get exactly zero."""


class OmniDrive(DriveModel):
    """The drives of some robots, each with its own memory: rim speeds, and the last planned twist."""

    held_back: Sequence[bool] = ()
    """Per robot, at the beginning of the tick: its motion is well below the last plan."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        limits = [(model.drive, time.physics_step, time.steps_per_tick) for model in models]
        self._ramps = [(Ramp(*limit), TurnRamp(*limit)) for limit in limits]
        self._wheels = WheelSets(models, time.physics_step)
        self._remembers = False
        self._commanded = np.zeros((3, len(models)))
        self._speeds = np.zeros((4, len(models)))
        self._way: list[Floats] = []
        """The planned twist of each step of the tick."""
        self.held_back = [False] * len(models)

    def reset(self) -> None:
        """Clear the memory: in the next tick the wheels roll without slip at the measured twists."""
        self._remembers = False

    def plan(self, robots: Sequence[RobotState], demands: Sequence[Drive], bodies: Bodies) -> Plan:
        """The velocities of one tick; each step follows the bodies as they are when it begins."""
        twist = _twist(robots)
        if not self._remembers:
            self._commanded, self._speeds = twist, self._wheels.rolling(twist)
            self._remembers = True
        self.held_back = _is_held_back(twist, self._commanded)
        within = [
            (*moving.within_limits(demand.vx, demand.vy), turning.within_limits(demand.omega))
            for (moving, turning), demand in zip(self._ramps, demands, strict=True)
        ]
        wanted = self._wheels.within_limit(_robots_last(within)).T.tolist()
        plans = zip(self._ramps, self._commanded.T.tolist(), wanted, strict=True)
        steps = zip(*[_plan(moving, turning, last, goal) for (moving, turning), last, goal in plans], strict=True)
        self._way = [self._wheels.within_limit(_robots_last(step)) for step in steps]
        self._commanded = self._way[-1]
        return self._follow(bodies)

    def _follow(self, bodies: Bodies) -> Iterator[list[FieldTwist]]:
        """The velocities of each step."""
        for number in range(len(self._way)):
            yield self.step(number, bodies.now())

    def step(self, number: int, robots: Sequence[RobotState]) -> list[FieldTwist]:
        """The velocities with which the robots, in their present state, begin one physics step of the tick."""
        wheels = self._wheels.step(_twist(robots), self._speeds, self._wheels.rolling(self._way[number]))
        self._speeds = wheels.speeds
        reached = zip(wheels.twist.T.tolist(), robots, strict=True)
        return [(*rotate(vx, vy, robot.heading), omega) for (vx, vy, omega), robot in reached]


def _plan(moving: Ramp, turning: TurnRamp, last: FieldTwist, wanted: FieldTwist) -> list[FieldTwist]:
    """The planned twist of one robot in each step, in the body frame."""
    x, y, omega = wanted
    velocities = moving.toward((last[0], last[1]), (x, y))
    reached = [(x, y) if math.hypot(vx - x, vy - y) < _SAME_SPEED else (vx, vy) for vx, vy in velocities]
    return [(*velocity, rate) for velocity, rate in zip(reached, turning.toward(last[2], omega), strict=True)]


def _twist(robots: Sequence[RobotState]) -> Floats:
    """Twists in the body frame, (3, n)."""
    return _robots_last([(*to_body(one.vx, one.vy, one.heading), one.omega) for one in robots])


def _robots_last(twists: Sequence[FieldTwist]) -> Floats:
    """One twist for each robot, as the array (3, n) of `sim_host.actuation.wheels`; there may be no robots."""
    return np.array(twists, dtype=float).reshape(len(twists), 3).T


def _is_held_back(twist: Floats, demands: Floats) -> list[bool]:
    """Robots whose speed along the plan is well below it: in moving, or in turning if they only turn."""
    wanted, wanted_turn = np.hypot(demands[0], demands[1]), np.abs(demands[2])
    slow = twist[0] * demands[0] + twist[1] * demands[1] < SLOW_SHARE * wanted**2
    slow_turn = (wanted_turn > MIN_TURN_RATE) & (twist[2] * demands[2] < SLOW_SHARE * wanted_turn**2)
    held: list[bool] = np.where(wanted > MIN_SPEED, slow, slow_turn).tolist()
    return held
