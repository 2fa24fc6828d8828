"""The drive model `differential`: two wheels on an axle through the centre of the robot, no motion along the axle.

A demand for speed ahead and turn rate is shortened as a whole until both wheels are within their limit, which keeps its
curvature; a demand for sideways motion is ignored. Speed ahead and turn rate approach it within the accelerations of
the drive. In each physics step the body's velocity changes toward the planned one by what the tyres can hold,
traction × g in any direction. A push along the axle is therefore resisted, and a robot that circles faster slides
outward. The plan of a robot that is held back leads the measured motion by this change, so that it goes on pushing.
"""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from schemas.config.robot_model import RobotModel
from schemas.config.rolling import GRAVITY
from schemas.config.sections import TimeSteps
from schemas.config.wheels import Wheels
from schemas.messages.command import Drive
from sim_host.actuation.drive_model import Bodies, DriveModel, Plan
from sim_host.actuation.stuck_detector import MIN_SPEED, MIN_TURN_RATE, SLOW_SHARE
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState, RobotStates

_Motion = tuple[float, float]
"""Speed ahead in m/s, turn rate in rad/s."""


class _Axle(NamedTuple):
    """The limits of one robot; changes are those of one physics step."""

    top_speed: float
    top_turn_rate: float
    wheels: Wheels
    gain: float
    loss: float
    turn_change: float
    grip: float
    turn_grip: float

    @classmethod
    def of(cls, model: RobotModel, step: float) -> "_Axle":
        """The limits of a model; `step` is the physics step in s."""
        drive, wheels, body = model.drive, model.wheels, model.body
        grip, turn = wheels.traction * GRAVITY * step, drive.turn_acceleration * step
        return cls(
            top_speed=drive.max_speed,
            top_turn_rate=drive.max_turn_rate,
            wheels=wheels,
            gain=drive.acceleration * step,
            loss=drive.deceleration * step,
            turn_change=turn,
            grip=grip,
            turn_grip=max(turn, body.mass * grip * wheels.arm / body.inertia_zz),
        )

    def within_rims(self, ahead: float, turn_rate: float) -> _Motion:
        """A motion shortened as a whole until its faster wheel is within its limit."""
        top = self.wheels.max_speed
        scale = top / max(top, *map(abs, self.wheels.rim_speeds(ahead, 0.0, turn_rate)))
        return ahead * scale, turn_rate * scale

    def within_limits(self, demand: Drive) -> _Motion:
        """A demand shortened as a whole until it is within all limits, with the same curvature."""
        excess = max(1.0, abs(demand.vx) / self.top_speed, abs(demand.omega) / self.top_turn_rate)
        return self.within_rims(demand.vx / excess, demand.omega / excess)

    def near(self, planned: _Motion, measured: _Motion) -> _Motion:
        """The planned motion, or the nearest one that the tyres can make of the measured one in a step."""
        ahead, turn_rate = measured
        return (
            max(ahead - self.grip, min(ahead + self.grip, planned[0])),
            max(turn_rate - self.turn_grip, min(turn_rate + self.turn_grip, planned[1])),
        )

    def toward(self, planned: _Motion, wanted: _Motion) -> _Motion:
        """The planned motion after one more step on its way to the wanted one."""
        ahead = _approach(planned[0], wanted[0], self.gain, self.loss)
        turn_rate = _approach(planned[1], wanted[1], self.turn_change, self.turn_change)
        return self.within_rims(ahead, turn_rate)


class DifferentialDrive(DriveModel):
    """The drives of some robots, each with its own memory: the motion that was planned last."""

    held_back: Sequence[bool] = ()

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        self._steps, self._half_step = time.steps_per_tick, time.physics_step / 2
        self._axles = [_Axle.of(model, time.physics_step) for model in models]
        self._planned: list[_Motion] | None = None
        self.held_back = [False] * len(models)

    def reset(self) -> None:
        """Clear the memory: the next tick begins from the measured speeds ahead and turn rates."""
        self._planned = None

    def possible(self, demands: Sequence[Drive]) -> Sequence[Drive]:
        """The demands without sideways motion."""
        return [Drive(vx=demand.vx, omega=demand.omega) if demand.vy else demand for demand in demands]

    def plan(self, robots: RobotStates, demands: Sequence[Drive], bodies: Bodies) -> Plan:
        """The velocities of one tick; each step follows the bodies as they are when it begins."""
        measured = [_measured(robot) for robot in robots]
        last = measured if self._planned is None else self._planned
        planned = [axle.near(*motions) for axle, *motions in zip(self._axles, last, measured, strict=True)]
        wanted = [axle.within_limits(demand) for axle, demand in zip(self._axles, demands, strict=True)]
        self.held_back = [
            near != before and _is_slow(now, goal)
            for near, before, now, goal in zip(planned, last, measured, wanted, strict=True)
        ]
        return self._follow(planned, wanted, bodies)

    def _follow(self, planned: list[_Motion], wanted: list[_Motion], bodies: Bodies) -> Iterator[list[FieldTwist]]:
        """The velocities of each step."""
        for _ in range(self._steps):
            ways = zip(self._axles, planned, wanted, strict=True)
            planned = self._planned = [axle.toward(*motions) for axle, *motions in ways]
            steps = zip(self._axles, bodies.now(), planned, strict=True)
            yield [self._roll(axle, robot, motion) for axle, robot, motion in steps]

    def _roll(self, axle: _Axle, robot: RobotState, planned: _Motion) -> FieldTwist:
        """The velocity nearest to the planned one that the tyres can make of the present one in a step.

        The direction ahead is taken at the heading halfway through the step.
        """
        turn = max(-axle.turn_grip, min(axle.turn_grip, planned[1] - robot.omega))
        heading = robot.heading + planned[1] * self._half_step
        c, s = math.cos(heading), math.sin(heading)
        dx, dy = planned[0] * c - robot.vx, planned[0] * s - robot.vy
        share = axle.grip / max(axle.grip, math.hypot(dx, dy))
        return robot.vx + share * dx, robot.vy + share * dy, robot.omega + turn


def _measured(robot: RobotState) -> _Motion:
    return robot.vx * math.cos(robot.heading) + robot.vy * math.sin(robot.heading), robot.omega


def _approach(now: float, wanted: float, gain: float, loss: float) -> float:
    """A number that approaches the wanted one by `loss` while it shrinks, and by `gain` while it grows."""
    if now * wanted < 0.0 or abs(wanted) < abs(now):
        rest = max(0.0, abs(now) - loss)
        return math.copysign(rest if now * wanted < 0.0 else max(rest, abs(wanted)), now)
    return math.copysign(min(abs(wanted), abs(now) + gain), wanted)


def _is_slow(measured: _Motion, wanted: _Motion) -> bool:
    """Whether a motion is well below its demand: in moving, or in turning if the robot is only to turn."""
    number, least = (0, MIN_SPEED) if abs(wanted[0]) > MIN_SPEED else (1, MIN_TURN_RATE)
    return abs(wanted[number]) > least and measured[number] * wanted[number] < SLOW_SHARE * wanted[number] ** 2
