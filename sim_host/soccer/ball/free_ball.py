"""The motion of a ball that no dribbler moves: it flies, slides, rolls and comes to rest.

The engine computes gravity, friction, and bounces off everything but the ground. Friction alone turns a slide into a
roll: a ball that starts without spin slides until it has 1 / (1 + I / (m·r²)) of its speed, 5/7 for a solid ball, 3/5
for a thin shell. This module adds rolling resistance, the forces of the air, and the bounce off the ground.
"""

import math

from schemas.config.sections import Ball, Pitch
from sim_host.physics.bounce import MIN_BOUNCE_SPEED, bounce
from sim_host.physics.vectors import Vector
from sim_host.soccer.ball.aerodynamics import Aerodynamics

_ON_GROUND = 0.01
"""m; a ball higher above the ground does not roll."""
_LIFT_OFF_SPEED = 0.2
"""m/s; a ball that is launched upward faster than this leaves the ground before it could roll."""
_SLIP_SPEED = 0.1
"""m/s between the ball's lowest point and the ground; with less slip the ball rolls, with more it slides."""


class FreeBall:
    """The forces on a ball that depend on its position and motion alone, for physics steps of `step` s."""

    def __init__(self, ball: Ball, pitch: Pitch, step: float) -> None:
        self._ball = ball
        self._pitch = pitch
        self._step = step
        self._air = Aerodynamics.of_ball(ball)
        self._rolling_mass = ball.mass + ball.inertia / ball.radius**2

    def is_in_air(self, z: float, vz: float) -> bool:
        """Whether a ball at height `z` m with vertical speed `vz` m/s is off the ground."""
        return z > self._ball.radius + _ON_GROUND or vz > _LIFT_OFF_SPEED

    def rolling_spin(self, vx: float, vy: float) -> Vector:
        """The spin in rad/s of a ball that rolls with this velocity."""
        return -vy / self._ball.radius, vx / self._ball.radius, 0.0

    def force(self, position: Vector, velocity: Vector, spin: Vector) -> Vector:
        """The force of ground and air on the ball, N."""
        if self.is_in_air(position[2], velocity[2]):
            ax, ay, az = self._air.acceleration(velocity, spin)
            mass = self._ball.mass
            return mass * ax, mass * ay, mass * az
        speed = math.hypot(velocity[0], velocity[1])
        if speed == 0.0:
            return 0.0, 0.0, 0.0
        push = -self._ball.mass * self._air.ground_drag * speed
        if not self._slides(velocity, spin):
            push -= self._rolling_mass * min(self._deceleration(position), speed / self._step) / speed
        return push * velocity[0], push * velocity[1], 0.0

    def sudden_change(self, position: Vector, velocity: Vector, spin: Vector) -> tuple[Vector, Vector] | None:
        """New velocity and spin of a ball that bounces or comes to rest in this step; None for any other."""
        if self.is_in_air(position[2], velocity[2]) or velocity[2] < -MIN_BOUNCE_SPEED:
            return bounce(self._ball, position[2] - self._ball.radius, velocity, spin, self._step)
        speed = math.hypot(velocity[0], velocity[1])
        if not 0.0 < speed <= self._deceleration(position) * self._step or self._slides(velocity, spin):
            return None
        return (0.0, 0.0, velocity[2]), (0.0, 0.0, 0.0)

    def _slides(self, velocity: Vector, spin: Vector) -> bool:
        radius = self._ball.radius
        return math.hypot(velocity[0] - radius * spin[1], velocity[1] + radius * spin[0]) > _SLIP_SPEED

    def _deceleration(self, position: Vector) -> float:
        """m/s²; rolling resistance on the carpet, or on the net inside a goal."""
        pitch = self._pitch
        in_net = abs(position[0]) > pitch.goal_line and abs(position[1]) < pitch.goal_width / 2
        return self._ball.net_deceleration if in_net else self._ball.rolling_deceleration
