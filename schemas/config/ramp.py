"""Limits on the speed and acceleration of one robot, which turn a demanded motion into possible ones.

A whole control tick is planned in one step, since the demand does not change within it. A limit keeps the direction of
the velocity that it shortens.

The loops are plain Python: for ten robots they take less time than numpy, and no vector unit rounds in them.
"""

import math

from schemas.config.sections import DriveLimits

Planar = tuple[float, float]
"""A velocity in the plane, in m/s."""


class Ramp:
    """The limits of a velocity, and its way toward a demand over the steps of one tick."""

    def __init__(self, drive: DriveLimits, step: float, steps: int) -> None:
        """`step` is the length of a step in s."""
        self._top = drive.max_speed
        elapsed = [step * number for number in range(1, steps + 1)]
        self._reach = [(drive.acceleration * time, drive.deceleration * time) for time in elapsed]
        """Per step: the speed that is gained at most, and lost at most, since the tick began, in m/s."""
        self._spent = drive.acceleration / drive.deceleration - 1.0
        self._bound = min if drive.acceleration <= drive.deceleration else max
        """Of both ways, the one that counts: the first until the speed is lost, then the second."""

    def within_limits(self, x: float, y: float) -> Planar:
        """A demanded velocity, scaled down to top speed."""
        speed, top = math.hypot(x, y), self._top
        return (x, y) if speed <= top else (x * top / speed, y * top / speed)

    def toward(self, now: Planar, demand: Planar) -> list[Planar]:
        """Velocities after each step, from the present one toward a demand within the limits.

        Speed against the direction of the change is first lost at the deceleration limit; then speed is gained at the
        acceleration limit.
        """
        (now_x, now_y), (x, y) = now, demand
        change = math.hypot(x - now_x, y - now_y)
        if not change:
            return [demand] * len(self._reach)
        along_x, along_y = (x - now_x) / change, (y - now_y) / change
        against = self._spent * min(0.0, now_x * along_x + now_y * along_y)
        reached = [self._bound(lost, gained + against) for gained, lost in self._reach]
        return [demand if size >= change else (now_x + size * along_x, now_y + size * along_y) for size in reached]


class TurnRamp:
    """The limits of a turn rate, and its way toward a demand over the steps of one tick."""

    def __init__(self, drive: DriveLimits, step: float, steps: int) -> None:
        """`step` is the length of a step in s."""
        self._top = drive.max_turn_rate
        self._reach = [drive.turn_acceleration * step * number for number in range(1, steps + 1)]
        """Per step: by how much the turn rate has changed at most since the tick began, in rad/s."""

    def within_limits(self, demand: float) -> float:
        """A demanded turn rate, as far as the limit allows."""
        return demand if abs(demand) <= self._top else math.copysign(self._top, demand)

    def toward(self, now: float, demand: float) -> list[float]:
        """Turn rates after each step, from the present one toward a demand within the limits."""
        if demand >= now:
            return [demand if now + most > demand else now + most for most in self._reach]
        return [demand if now - most < demand else now - most for most in self._reach]
