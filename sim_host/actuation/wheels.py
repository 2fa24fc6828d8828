"""Omnidirectional wheels of many robots: commanded rim speeds become forces, within the limits of motors and grip.

Each wheel has a commanded rim speed. Its controller demands a motor torque in proportion to the missing speed, within
the motor's torque-speed line. The ground returns a force along the rim that grows with the slip, up to traction × the
weight on the wheel. Across the rim the rollers roll freely. The weight is spread evenly over the wheels. Motor
quantities are converted to the rim: torque × gear / radius is a force, inertia × gear² / radius² a mass.

The step is implicit, since controller and grip are stiff on the scale of milliseconds: the forces are consistent with
the speeds that result from them.

Robots are on the last axis of all arrays. Twists are (3, n): vx and vy in m/s and omega in rad/s, in the body frame.
Wheels are (4, n); a robot on three wheels has a fourth that touches nothing. All arithmetic is elementwise, which gives
the same bits on every machine.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from schemas.config.robot_model import RobotModel
from schemas.config.rolling import GRAVITY
from schemas.config.wheels import Wheels

Floats = NDArray[np.float64]

_MAX_WHEELS = 4
"""Maximum number of wheels; the arrays have this many for each robot, some of which may touch nothing."""
_ROUNDS = 6
"""Iterations for the forces of a robot's wheels, to 1 % when some slide; two are enough with no wheel at a limit."""


class WheelStep(NamedTuple):
    """The result of one step."""

    push: Floats
    """(3, n): force along x and y in N, torque about z in N·m, in the body frame at the beginning of the step."""
    twist: Floats
    """(3, n): the twist that results from this push alone, in the same frame."""
    speeds: Floats
    """(4, n): rim speeds after the step, m/s."""
    traction: Floats
    """(4, n): force of the ground along the rim of each wheel, N."""


class WheelSets:
    """The wheels of some robots, without state: the caller keeps the rim speeds."""

    def __init__(self, models: Sequence[RobotModel], step: float) -> None:
        def each(number: Callable[[Wheels], float]) -> Floats:
            return np.array([number(model.wheels) for model in models])

        load = np.array([model.body.mass * GRAVITY / model.wheels.count for model in models])
        masses = [(model.body.mass, model.body.mass, model.body.inertia_zz) for model in models]
        stall = each(lambda w: w.stall_torque * w.gear / w.radius)
        line = stall / each(lambda w: w.no_load_rim_speed)
        gain = each(lambda w: w.gain * w.gear**2 / w.radius**2)
        creep = 1 / (load * each(lambda w: w.slip_stiffness))
        self._step = step
        self._limit = each(lambda w: w.max_speed)
        self._geometry = _robots_last([_geometry(model.wheels) for model in models], (_MAX_WHEELS, 3))
        self._grip = load * each(lambda w: w.traction) * (self._geometry != 0).any(axis=1)
        self._rim_mass = each(lambda w: (w.inertia + w.rotor_inertia * w.gear**2) / w.radius**2)
        self._gain_impulse, self._stall_impulse = step * gain, step * stall
        # Effective mass of a rim that speeds up: its own, and the controller's or the motor line's.
        self._controlled_mass, self._motor_mass = self._rim_mass + step * gain, self._rim_mass + step * line
        # Decrease of a wheel's force for each m/s of the ground under it.
        self._controlled_slope = 1 / (creep + step / self._controlled_mass)
        self._motor_slope = 1 / (creep + step / self._motor_mass)
        self._step_over_mass = step / _robots_last(masses, (3,))
        steepest = np.maximum(self._controlled_slope, self._motor_slope)
        self._damping = 1 / (1 + self._step_over_mass * steepest * (self._geometry**2).sum(axis=0))

    def rolling(self, twist: Floats) -> Floats:
        """Rim speeds, (4, n), of wheels that roll without slip at a twist."""
        speeds: Floats = (self._geometry * twist).sum(axis=1)
        return speeds

    def within_limit(self, twist: Floats) -> Floats:
        """The twist, scaled down as a whole until its fastest wheel is within its limit."""
        fastest = np.abs(self.rolling(twist)).max(axis=0)
        shortened: Floats = twist * (self._limit / np.maximum(fastest, self._limit))
        return shortened

    def step(self, twist: Floats, speeds: Floats, commanded: Floats) -> WheelStep:
        """Simulate one physics step of robots with this twist, and wheels with these actual and commanded rim speeds.

        A wheel's force decreases with the speed of the ground under it, and has a closed form: the controller's demand,
        limited by the motor in both directions, limited by the grip. The twist that is consistent with the forces of
        all wheels is found by a few Newton iterations with the steepest slope, which cannot overshoot.
        """
        momentum = self._rim_mass * speeds
        controlled = (momentum + self._gain_impulse * commanded) / self._controlled_mass
        upper = (momentum + self._stall_impulse) / self._motor_mass
        lower = (momentum - self._stall_impulse) / self._motor_mass
        after = twist
        for _ in range(_ROUNDS):
            ground = self.rolling(after)
            force = np.maximum((controlled - ground) * self._controlled_slope, (lower - ground) * self._motor_slope)
            force = np.minimum(force, (upper - ground) * self._motor_slope)
            force = np.minimum(np.maximum(force, -self._grip), self._grip)
            push = (self._geometry * force[:, None]).sum(axis=0)
            reached = twist + self._step_over_mass * push
            after = after + (reached - after) * self._damping
        lost = self._step * force
        rims = np.maximum(controlled - lost / self._controlled_mass, lower - lost / self._motor_mass)
        return WheelStep(push, reached, np.minimum(rims, upper - lost / self._motor_mass), force)


def _robots_last(each: Sequence[ArrayLike], shape: tuple[int, ...]) -> Floats:
    """Stack arrays of this shape, one for each robot, on the last axis; there may be no robots."""
    return np.ascontiguousarray(np.moveaxis(np.array(each, dtype=float).reshape(len(each), *shape), 0, -1))


def _geometry(wheels: Wheels) -> Floats:
    """(4, 3): the rim speed of each wheel for a unit of vx, vy and omega; zeros for a missing wheel."""
    return np.array([*wheels.rows, *[(0.0, 0.0, 0.0)] * (_MAX_WHEELS - wheels.count)])
