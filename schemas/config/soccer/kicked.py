"""How a ball that was kicked along the ground moves; for robots and statistics.

It slides until friction has given it the spin of rolling, and then rolls. With k = I / (m·r²), friction f = μ·g and the
share s of the spin of rolling that a kick gives, a ball of speed v₀ rolls when its speed has become
v₀·(1 + s·k) / (1 + k), less what the air takes meanwhile.
"""

import math
from typing import NamedTuple

from schemas.config.rolling import GRAVITY, Rolling
from schemas.config.sections import Ball, Kicker

_ROUNDS = 8
"""Iterations at most; four are enough for 1e-9."""
_NEAR = 1e-9
"""s, m²/s²."""


class Kicked(NamedTuple):
    """What slows a ball that was kicked along the ground."""

    rolling: Rolling
    sliding: Rolling
    """Friction and air, while it slides."""
    inertia: float
    """I / (m·r²): 2/5 for a solid ball, 2/3 for a thin shell."""
    spin: float
    """Share of the spin of rolling that a kick gives."""

    @classmethod
    def of(cls, ball: Ball, kicker: Kicker) -> "Kicked":
        """The resistance of a profile's ball after a kick by a kicker."""
        air = 0.5 * ball.air_density * ball.rolling_drag_coefficient * math.pi * ball.radius**2 / ball.mass
        inertia = ball.inertia / (ball.mass * ball.radius**2)
        return cls(Rolling.of(ball), Rolling(GRAVITY * ball.friction, air), inertia, kicker.kick_spin)

    def slide(self, speed: float) -> float:
        """Time in s until a ball that left the kicker at `speed` m/s rolls."""
        friction, missing = self.sliding.deceleration, (1.0 - self.spin) * speed
        if missing <= 0.0:
            return 0.0
        if friction == 0.0:
            return math.inf
        time = missing / (friction * (1.0 + 1.0 / self.inertia))
        for _ in range(_ROUNDS):
            left, _ = self.sliding.after(speed, time)
            faster = left - self.spin * speed - friction / self.inertia * time
            slope = friction * (1.0 + 1.0 / self.inertia) + self.sliding.drag * left * left
            time += faster / slope
            if abs(faster) < _NEAR:
                break
        return time

    def after(self, speed: float, time: float) -> tuple[float, float]:
        """Speed in m/s and distance in m, `time` s after a kick of `speed` m/s."""
        slide = self.slide(speed)
        if time <= slide:
            return self.sliding.after(speed, time)
        rolls, way = self.sliding.after(speed, slide)
        left, distance = self.rolling.after(rolls, time - slide)
        return left, way + distance

    def speed_to_arrive(self, arriving: float, distance: float) -> float:
        """The speed in m/s of a kick whose ball still moves at `arriving` m/s after `distance` m."""
        if self.sliding.deceleration == 0.0 and self.spin < 1.0:
            return self.sliding.speed_to_arrive(arriving, distance)
        kept = (1.0 + self.spin * self.inertia) / (1.0 + self.inertia)
        least = self.rolling.speed_to_arrive(arriving, distance)
        if kept >= 1.0 or least == 0.0:
            return least
        # Squares of speeds, which depend on each other almost linearly.
        one, other = least**2, (least / kept) ** 2
        at_one, at_other = (self._square_at(square, distance) - arriving**2 for square in (one, other))
        for _ in range(_ROUNDS):
            if abs(at_other) < _NEAR or at_other == at_one:
                break
            one, other = other, max(least**2, other - at_other * (other - one) / (at_other - at_one))
            at_one, at_other = at_other, self._square_at(other, distance) - arriving**2
        return math.sqrt(other)

    def _square_at(self, square: float, distance: float) -> float:
        """Square of the speed at a distance, of a kick with this square of its speed; negative if it stops before."""
        speed = math.sqrt(square)
        slide = self.slide(speed)
        rolls, way = self.sliding.after(speed, slide)
        if way >= distance:
            return _square_after(self.sliding, square, distance)
        return _square_after(self.rolling, rolls * rolls, distance - way)


def _square_after(resistance: Rolling, square: float, distance: float) -> float:
    """Square of the speed after a distance; negative if the ball stops before."""
    ground, air = resistance
    if air == 0.0:
        return square - 2.0 * ground * distance
    return (square + ground / air) * math.exp(-2.0 * air * distance) - ground / air
