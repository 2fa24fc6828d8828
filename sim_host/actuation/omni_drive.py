"""The drive model `omni`: wheels follow the planned velocity as far as motors and grip allow.

The robot's controller plans as the drive model `velocity` does, but from its last plan, not from the measured motion: a
robot that is held back goes on pushing. The body keeps the engine's velocity, to which each physics step adds the
change by the wheels' forces.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.messages.command import Drive
from sim_host.actuation.drive_model import Bodies, DriveModel, Plan
from sim_host.actuation.ramp import Flags, Floats, Ramp
from sim_host.actuation.stuck_detector import MIN_SPEED, MIN_TURN_RATE, SLOW_SHARE
from sim_host.actuation.wheels import WheelSets
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState

_SAME_SPEED = 1e-9
"""m/s; a plan this near to the demand is set to the demand, so that wheels that shall rest get exactly zero."""


class OmniDrive(DriveModel):
    """The drives of some robots, each with its own memory: rim speeds, and the last planned twist."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        drives = [model.drive for model in models]
        self._moving = Ramp.of_moving(drives, time.physics_step, time.steps_per_tick)
        self._turning = Ramp.of_turning(drives, time.physics_step, time.steps_per_tick)
        self._wheels = WheelSets(models, time.physics_step)
        self._remembers = False
        self._commanded = np.zeros((3, len(models)))
        self._speeds = np.zeros((4, len(models)))
        self._way: list[Floats] = []
        """The planned twist of each step of the tick."""
        self.held_back: Flags = np.zeros(len(models), dtype=bool)
        """Per robot, at the beginning of the tick: its motion is well below the last plan."""

    def reset(self) -> None:
        """Clear the memory: in the next tick the wheels roll without slip at the measured twists."""
        self._remembers = False

    def plan(self, robots: Sequence[RobotState], demands: Sequence[Drive], bodies: Bodies) -> Plan:
        """The velocities of one tick; each step follows the bodies as they are when it begins."""
        twist, _ = _twist(robots)
        if not self._remembers:
            self._commanded, self._speeds = twist, self._wheels.rolling(twist)
            self._remembers = True
        self.held_back = _is_held_back(twist, self._commanded)
        demand = self._moving.within_limits(np.array([complex(one.vx, one.vy) for one in demands]))
        turn = self._turning.within_limits(np.array([one.omega for one in demands]))
        vx, vy, omega = self._wheels.within_limit(np.stack([demand.real, demand.imag, turn]))
        wanted = vx + 1j * vy
        velocities = self._moving.toward(self._commanded[0] + 1j * self._commanded[1], wanted)
        velocities = np.where(np.abs(velocities - wanted) < _SAME_SPEED, wanted, velocities)
        turn_rates = self._turning.toward(self._commanded[2], omega)
        steps = zip(velocities.real, velocities.imag, turn_rates, strict=True)
        self._way = [self._wheels.within_limit(np.stack(step)) for step in steps]
        self._commanded = self._way[-1]
        return self._follow(bodies)

    def _follow(self, bodies: Bodies) -> Iterator[list[FieldTwist]]:
        """The velocities of each step."""
        for number in range(len(self._way)):
            yield self.step(number, bodies.now())

    def step(self, number: int, robots: Sequence[RobotState]) -> list[FieldTwist]:
        """The velocities with which the robots, in their present state, begin one physics step of the tick."""
        twist, turned = _twist(robots)
        wheels = self._wheels.step(twist, self._speeds, self._wheels.rolling(self._way[number]))
        self._speeds = wheels.speeds
        vx, vy, omega = wheels.twist
        in_field = (vx + 1j * vy) * turned
        return list(zip(in_field.real.tolist(), in_field.imag.tolist(), omega.tolist(), strict=True))


def _twist(robots: Sequence[RobotState]) -> tuple[Floats, Floats]:
    """Twists in the body frame, (3, n), and per robot the complex factor that turns them into the field frame."""
    state = np.array(robots)
    turned = np.exp(1j * state[:, 3])
    body = (state[:, 4] + 1j * state[:, 5]) * turned.conj()
    return np.stack([body.real, body.imag, state[:, 6]]), turned


def _is_held_back(twist: Floats, demands: Floats) -> Flags:
    """Robots whose speed along the plan is well below it: in moving, or in turning if they only turn."""
    wanted, wanted_turn = np.hypot(demands[0], demands[1]), np.abs(demands[2])
    slow = twist[0] * demands[0] + twist[1] * demands[1] < SLOW_SHARE * wanted**2
    slow_turn = (wanted_turn > MIN_TURN_RATE) & (twist[2] * demands[2] < SLOW_SHARE * wanted_turn**2)
    held: Flags = np.where(wanted > MIN_SPEED, slow, slow_turn)
    return held
