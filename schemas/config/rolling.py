"""How a ball that rolls freely slows down: by the ground, and by the air; closed forms for robots and statistics.

dv/dt = -(deceleration + drag · v²): the equation of free fall with the signs of a climb, whose solution is a tangent.
"""

import math
from typing import NamedTuple

from schemas.config.sections import Ball

GRAVITY = 9.81
"""m/s², as in the world file of nubot-nu's simatch."""


class Rolling(NamedTuple):
    """What slows a rolling ball."""

    deceleration: float
    """m/s²; by the ground, at any speed."""
    drag: float = 0.0
    """1/m; by the air, over speed²."""

    @classmethod
    def of(cls, ball: Ball) -> "Rolling":
        """The resistance of a profile's ball, which turns as it rolls and therefore has more inertia than its mass."""
        force = 0.5 * ball.air_density * ball.rolling_drag_coefficient * math.pi * ball.radius**2
        return cls(ball.rolling_deceleration, force / (ball.mass + ball.inertia / ball.radius**2))

    def after(self, speed: float, time: float) -> tuple[float, float]:
        """Speed in m/s and distance in m, `time` s after a ball rolled at `speed` m/s."""
        ground, air = self
        if air == 0.0:
            left = speed - ground * time
            rolls = left > 0.0 or ground == 0.0
            return (left, 0.5 * (speed + left) * time) if rolls else (0.0, 0.5 * speed * speed / ground)
        if ground == 0.0:
            slowing = 1.0 + air * speed * time
            return speed / slowing, math.log(slowing) / air
        rate, scale = math.sqrt(ground * air), math.sqrt(ground / air)
        angle = math.atan(speed / scale)
        left = max(0.0, angle - rate * time)
        return scale * math.tan(left), math.log(math.cos(left) / math.cos(angle)) / air

    def speed_to_arrive(self, arriving: float, distance: float) -> float:
        """The speed in m/s of a ball that still rolls at `arriving` m/s after `distance` m."""
        ground, air = self
        if air == 0.0:
            return math.sqrt(arriving * arriving + 2.0 * ground * distance)
        grown = math.exp(2.0 * air * distance)
        return math.sqrt((arriving * arriving + ground / air) * grown - ground / air)
