"""The forces of the air on a ball: drag against its velocity, and in flight the Magnus force across it."""

import math
from typing import NamedTuple

from schemas.config.sections import Ball
from sim_host.physics.vectors import Vector


class Aerodynamics(NamedTuple):
    """The coefficients of the air for one kind of ball."""

    drag: float
    """1/m: deceleration over speed²; ½·ρ·c_d·π·r² / m."""
    magnus: float
    """1: acceleration over spin × velocity; ½·ρ·c_m·π·r³ / m, since a ball rolls at spin = speed / radius."""
    ground_drag: float
    """1/m: the same as `drag` for a ball on the ground."""

    @classmethod
    def of_ball(cls, ball: Ball) -> "Aerodynamics":
        """The coefficients for the ball and the air of a profile."""
        share = 0.5 * ball.air_density * math.pi * ball.radius**2 / ball.mass
        return cls(
            share * ball.drag_coefficient,
            share * ball.magnus_coefficient * ball.radius,
            share * ball.rolling_drag_coefficient,
        )

    def acceleration(self, velocity: Vector, spin: Vector) -> Vector:
        """Acceleration of a ball in flight in m/s², from velocity in m/s and spin in rad/s."""
        vx, vy, vz = velocity
        wx, wy, wz = spin
        slowing, lift = -self.drag * math.sqrt(vx * vx + vy * vy + vz * vz), self.magnus
        return (
            slowing * vx + lift * (wy * vz - wz * vy),
            slowing * vy + lift * (wz * vx - wx * vz),
            slowing * vz + lift * (wx * vy - wy * vx),
        )
