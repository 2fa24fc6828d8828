"""The drive `omni`: wheels are told what the limits allow, and push the robot as far as motors and grip let them.

The controller of the robot plans as `velocity` does, but from what it told last, not from what came of it: a robot
that is held back goes on pushing. The velocity of the body is the engine's own, to which each physics step adds what
the wheels' forces change in it.
"""

from collections.abc import Sequence

import numpy as np

from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.messages.command import Drive
from sim_host.actuation.ramp import Flags, Floats, Ramp
from sim_host.actuation.stuck_detector import MIN_SPEED, MIN_TURN_RATE, SLOW_SHARE
from sim_host.actuation.wheels import WheelSets
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState

_SAME_SPEED = 1e-9
"""m/s; what is told is the demand itself when it is this near, so that wheels told to rest are told zero."""


class OmniDrive:
    """Some robots of this drive, each with its own memory: rim speeds, and the twist that was told last."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel]) -> None:
        drives = [model.drive for model in models]
        self._moving = Ramp.of_moving(drives, time.physics_step, time.steps_per_tick)
        self._turning = Ramp.of_turning(drives, time.physics_step, time.steps_per_tick)
        self._wheels = WheelSets(models, time.physics_step)
        self._remembers = False
        self._commanded = np.zeros((3, len(models)))
        self._speeds = np.zeros((4, len(models)))
        self._plan: list[Floats] = []
        self.held_back: Flags = np.zeros(len(models), dtype=bool)
        """Per robot, as the tick begins: it is well below what it was told last."""

    def reset(self) -> None:
        """Remember nothing: in the next tick the wheels roll without slip at the twists that are measured."""
        self._remembers = False

    def plan(self, robots: Sequence[RobotState], demands: Sequence[Drive]) -> None:
        """Begin a tick of robots that are told these velocities, in their body frames."""
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
        self._plan = [self._wheels.within_limit(np.stack(step)) for step in steps]
        self._commanded = self._plan[-1]

    def step(self, number: int, robots: Sequence[RobotState]) -> list[FieldTwist]:
        """The velocities with which the robots, as they are now, begin one physics step of the tick."""
        twist, turned = _twist(robots)
        wheels = self._wheels.step(twist, self._speeds, self._wheels.rolling(self._plan[number]))
        self._speeds = wheels.speeds
        vx, vy, omega = wheels.twist
        in_field = (vx + 1j * vy) * turned
        return list(zip(in_field.real.tolist(), in_field.imag.tolist(), omega.tolist(), strict=True))


def _twist(robots: Sequence[RobotState]) -> tuple[Floats, Floats]:
    """Twists in the body frame, (3, n), and for each robot the complex number that turns into the field frame."""
    state = np.array(robots)
    turned = np.exp(1j * state[:, 3])
    body = (state[:, 4] + 1j * state[:, 5]) * turned.conj()
    return np.stack([body.real, body.imag, state[:, 6]]), turned


def _is_held_back(twist: Floats, demands: Floats) -> Flags:
    """Robots whose speed along what they were told is well below it: in moving, or in turning if that is all."""
    wanted, wanted_turn = np.hypot(demands[0], demands[1]), np.abs(demands[2])
    slow = twist[0] * demands[0] + twist[1] * demands[1] < SLOW_SHARE * wanted**2
    slow_turn = (wanted_turn > MIN_TURN_RATE) & (twist[2] * demands[2] < SLOW_SHARE * wanted_turn**2)
    held: Flags = np.where(wanted > MIN_SPEED, slow, slow_turn)
    return held
