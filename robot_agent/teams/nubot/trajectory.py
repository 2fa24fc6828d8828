"""The paper's trajectories: a trapezoid of speed with quadratic blends of position, and a floor so that it arrives."""

import math
from typing import NamedTuple


class Trapezoid(NamedTuple):
    """Acceleration and deceleration, top speed and least speed, of a translation or of a rotation."""

    acceleration: float
    top: float
    floor: float

    def next_speed(self, speed: float, left: float, dt: float) -> float:
        """The speed `dt` s after `speed`, with `left` still to go; never below the floor."""
        braking = math.sqrt(2.0 * self.acceleration * max(0.0, left))
        return max(self.floor, min(speed + self.acceleration * dt, self.top, braking))


TRANSLATION = Trapezoid(acceleration=2.0, top=3.0, floor=0.2)
"""m/s², m/s, m/s; the paper's plugin."""
ROTATION = Trapezoid(math.radians(120.0), math.radians(120.0), math.radians(10.0))
"""rad/s², rad/s, rad/s; the paper's plugin: 120 deg/s², 120 deg/s, 10 deg/s."""
