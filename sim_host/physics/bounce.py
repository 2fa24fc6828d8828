"""The bounce of a ball off the ground: restitution upward, and friction between slide and spin.

The engine's own rebound depends on how deep the ball is in the ground when a step begins: after a drop of 1 m the ball
regains a fifth to a half of the height, whatever the coefficient. So the ground has no restitution in the engine.
Instead, the step in which a falling ball would reach the ground begins with the velocity and spin after the bounce.
"""

import math

from schemas.config.rolling import GRAVITY
from schemas.config.sections import Ball
from sim_host.physics.vectors import Vector

MIN_BOUNCE_SPEED = 0.2
"""m/s; a slower impact does not bounce. Gravity alone adds 0.05 m/s in a step: with less, a ball would never rest."""


def bounce(ball: Ball, height: float, velocity: Vector, spin: Vector, step: float) -> tuple[Vector, Vector] | None:
    """Velocity and spin at the beginning of a step in which the ball bounces; None if it does not bounce in this step.

    `height`: of the ball's lowest point above the ground, m; `step`: s. In the engine's sum over steps, a ball with
    speed v has fallen v²/2g + v·step/2, and one that begins a step with v rises by as much. The ball therefore regains
    restitution² of the height that it fell from, at whatever moment of the step the impact occurs.
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
    """Velocity and spin after friction has stopped the slide of the lowest point, or taken `most` m/s of speed."""
    r, (vx, vy), (wx, wy, wz) = ball.radius, velocity, spin
    slide_x, slide_y = vx - r * wy, vy + r * wx
    slide = math.hypot(slide_x, slide_y)
    if slide == 0.0:
        return velocity, spin
    turning = ball.mass * r * r / ball.inertia
    taken = min(most, slide / (1.0 + turning)) / slide
    dx, dy = taken * slide_x, taken * slide_y
    return (vx - dx, vy - dy), (wx - turning * dy / r, wy + turning * dx / r, wz)
