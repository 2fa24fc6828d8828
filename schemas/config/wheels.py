"""The wheels of a robot: the numbers of a profile, and what follows from them for rim speeds and twists."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Annotated

from schemas.config.quantity import Quantity


@dataclass(frozen=True, slots=True)
class Wheels:
    """The wheels of a robot whose drive is `omni` or `differential`: evenly spaced, axles toward the centre.

    Those of `omni` have free rollers. `differential` has two with tyres, and reads `count`, `arm`, `max_speed` and
    `traction` only.
    """

    count: Annotated[int, Quantity("1", "number of wheels; 2 of a differential drive", 2, 4)]
    angle: Annotated[float, Quantity("rad", "kick axis to the first wheel; the others follow evenly", -3.2, 3.2)]
    arm: Annotated[float, Quantity("m", "centre of the robot to the wheels", 0.05, 0.6)]
    radius: Annotated[float, Quantity("m", "radius of a wheel", 0.01, 0.2)]
    inertia: Annotated[float, Quantity("kg·m²", "moment of inertia of a wheel about its axle", 0, 0.1)]
    gear: Annotated[float, Quantity("1", "turns of the motor for one turn of the wheel", 0.5, 200)]
    stall_torque: Annotated[
        float, Quantity("N·m", "torque of a motor at rest; it decreases linearly with speed", 1e-3, 100)
    ]
    no_load_speed: Annotated[float, Quantity("rad/s", "speed of a motor at which its torque is zero", 1, 1e4)]
    rotor_inertia: Annotated[float, Quantity("kg·m²", "moment of inertia of a motor's rotor", 1e-7, 0.01)]
    max_speed: Annotated[float, Quantity("m/s", "highest commanded rim speed of a wheel", 0.1, 30)]
    gain: Annotated[float, Quantity("N·m·s/rad", "motor torque for each rad/s of speed error", 1e-4, 10)]
    traction: Annotated[float, Quantity("1", "grip: largest force along the rim over the weight on the wheel", 0, 3)]
    slip_stiffness: Annotated[float, Quantity("s/m", "share of the grip in use for each m/s of slip", 0.1, 200)]

    @property
    def no_load_rim_speed(self) -> float:
        """Rim speed at which the torque of the motors is zero, in m/s."""
        return self.no_load_speed * self.radius / self.gear

    @property
    def rows(self) -> tuple[tuple[float, float, float], ...]:
        """Per wheel: its rim speed for a unit of vx, vy and omega in the body frame.

        A rim speed is positive where it turns the robot counter-clockwise: of two wheels, the first is the left one,
        whose speed ahead is negative.
        """
        return _wheel_rows(self.count, self.angle, self.arm)

    def rim_speeds(self, vx: float, vy: float, omega: float) -> tuple[float, ...]:
        """Per wheel: its rim speed in m/s if it rolls without slip at a twist, in m/s and rad/s in the body frame."""
        return tuple(ahead * vx + aside * vy + arm * omega for ahead, aside, arm in self.rows)

    def twist(self, rim_speeds: Sequence[float]) -> tuple[float, float, float]:
        """The twist, vx, vy and omega in the body frame, at which wheels with these rim speeds roll without slip.

        Of four wheels, whose speeds may contradict each other, it is the twist with the least squares of slip.
        """
        count, across = self.count, 2.0 if self.count > 2 else 1.0
        pairs = list(zip(self.rows, rim_speeds, strict=True))
        vx = across / count * sum(row[0] * speed for row, speed in pairs)
        vy = across / count * sum(row[1] * speed for row, speed in pairs)
        return vx, vy, sum(rim_speeds) / (count * self.arm)


@cache
def _wheel_rows(count: int, angle: float, arm: float) -> tuple[tuple[float, float, float], ...]:
    if count == 2:
        return ((-1.0, 0.0, arm), (1.0, 0.0, arm))
    angles = [angle + 2 * math.pi * number / count for number in range(count)]
    return tuple((-math.sin(one), math.cos(one), arm) for one in angles)
