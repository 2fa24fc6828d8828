"""The ball as ground and air move it while no dribbler does: it flies, slides, rolls and comes to rest.

Gravity, friction and bounces off everything but the ground are the engine's. Friction alone turns a slide into a roll:
a ball that starts without spin slides until it has 1 / (1 + I / (m·r²)) of its speed, 5/7 for a solid ball, 3/5 for a
thin shell. Added here are rolling resistance, the forces of the air, and the bounce off the ground.
"""

import math

from schemas.config.sections import Ball, Pitch
from sim_host.physics.aerodynamics import Aerodynamics
from sim_host.physics.bounce import MIN_BOUNCE_SPEED, bounce
from sim_host.physics.vectors import Vector

_ON_GROUND = 0.01
"""m; a ball with more air below it does not roll."""
_LIFT_OFF_SPEED = 0.2
"""m/s; a ball that is launched faster than this is off the ground before it could roll."""
_SLIP_SPEED = 0.1
"""m/s between the ball's lowest point and the ground; below it the ball rolls, and the engine's friction is at work."""


class FreeBall:
    """The forces on a ball that depend on its place and motion alone; each in N, for one physics step of `step` s."""

    def __init__(self, ball: Ball, pitch: Pitch, step: float) -> None:
        self._ball = ball
        self._pitch = pitch
        self._step = step
        self._air = Aerodynamics.of_ball(ball)
        self._rolling_mass = ball.mass + ball.inertia / ball.radius**2

    def is_in_air(self, z: float, vz: float) -> bool:
        """Whether a ball at height `z` m with vertical speed `vz` m/s touches no ground."""
        return z > self._ball.radius + _ON_GROUND or vz > _LIFT_OFF_SPEED

    def rolling_spin(self, vx: float, vy: float) -> Vector:
        """The spin, rad/s, of a ball that rolls at this velocity."""
        return -vy / self._ball.radius, vx / self._ball.radius, 0.0

    def force(self, position: Vector, velocity: Vector, spin: Vector) -> Vector:
        """What slows or bends the way of the ball in this state."""
        if self.is_in_air(position[2], velocity[2]):
            ax, ay, az = self._air.acceleration(velocity, spin)
            mass = self._ball.mass
            return mass * ax, mass * ay, mass * az
        speed = math.hypot(velocity[0], velocity[1])
        if speed == 0.0 or self._slides(velocity, spin):
            return 0.0, 0.0, 0.0
        push = -self._rolling_mass * min(self._deceleration(position), speed / self._step) / speed
        return push * velocity[0], push * velocity[1], 0.0

    def sudden_change(self, position: Vector, velocity: Vector, spin: Vector) -> tuple[Vector, Vector] | None:
        """Velocity and spin that a ball has all at once, when it bounces in this step or comes to rest."""
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
        """m/s²; rolling resistance on the carpet, or in a net that lies on it."""
        pitch = self._pitch
        in_net = abs(position[0]) > pitch.goal_line and abs(position[1]) < pitch.goal_width / 2
        return self._ball.net_deceleration if in_net else self._ball.rolling_deceleration
