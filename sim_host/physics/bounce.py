"""How a ball bounces off the ground: restitution upward, friction between slide and spin, as in a textbook.

The engine's own rebound depends on how deep the ball happens to be in the ground when a step begins, and gives back a
fifth to a half of a drop of 1 m whatever the coefficient says. So the ground has no restitution in the engine, and the
step in which a falling ball would reach the ground begins with the velocity and spin that it leaves the ground with.
"""

import math

from schemas.config.sections import Ball
from sim_host.physics.gravity import GRAVITY
from sim_host.physics.vectors import Vector

MIN_BOUNCE_SPEED = 0.2
"""m/s; a slower impact does not bounce. Gravity alone brings 0.05 m/s in a step: below that a ball never rests."""


def bounce(ball: Ball, height: float, velocity: Vector, spin: Vector, step: float) -> tuple[Vector, Vector] | None:
    """Velocity and spin with which to begin a step that ends in a bounce; nothing when the ball does not bounce in it.

    `height`: of the ball's lowest point above the ground, m; `step`: s. In the engine's sum over steps a ball of speed
    v has fallen v²/2g + v·step/2 before, and rises v²/2g + v·step/2 with the step that begins at v: so it comes to
    restitution² of where it fell from, wherever in the step the impact lies.
    """
    vx, vy, vz = velocity
    above, down, drop = max(height, 0.0), max(-vz, 0.0), GRAVITY * step
    if height > (drop - vz) * step:
        return None
    fallen = above + (down + drop) * down / (2.0 * GRAVITY)
    impact = math.sqrt(2.0 * GRAVITY * fallen)
    if impact < MIN_BOUNCE_SPEED:
        return None
    left = max(ball.restitution**2 * fallen - above, 0.0)
    rise = math.sqrt(drop * drop / 4.0 + 2.0 * GRAVITY * left) - drop / 2.0
    (vx, vy), spin = _after_friction(ball, (vx, vy), spin, ball.friction * (1.0 + ball.restitution) * impact)
    return (vx, vy, rise + drop), spin


def _after_friction(
    ball: Ball, velocity: tuple[float, float], spin: Vector, most: float
) -> tuple[tuple[float, float], Vector]:
    """Velocity and spin after friction has taken the slide of the lowest point, or `most` m/s of the ball's speed."""
    r, (vx, vy), (wx, wy, wz) = ball.radius, velocity, spin
    slide_x, slide_y = vx - r * wy, vy + r * wx
    slide = math.hypot(slide_x, slide_y)
    if slide == 0.0:
        return velocity, spin
    turning = ball.mass * r * r / ball.inertia
    taken = min(most, slide / (1.0 + turning)) / slide
    dx, dy = taken * slide_x, taken * slide_y
    return (vx - dx, vy - dy), (wx - turning * dy / r, wy + turning * dx / r, wz)
