"""The highest speed that still allows to stop in time, and the time that a distance takes."""

import math


def braking_speed(distance: float, deceleration: float, lag: float) -> float:
    """The speed from which a robot stops within `distance`, when braking begins `lag` s late.

    Solves v·lag + v²/(2·deceleration) = distance: far away the square root of a trapezoid's last edge, close by
    distance/lag, which does not magnify the noise of the distance as the square root does.
    """
    return deceleration * (math.sqrt(lag * lag + 2.0 * max(0.0, distance) / deceleration) - lag)


def travel_time(distance: float, speed: float, top_speed: float, acceleration: float, deceleration: float) -> float:
    """Time to cover `distance` at full power, beginning with `speed` toward the end (negative: away), not stopping."""
    if speed < 0.0:
        back = speed * speed / (2.0 * deceleration)
        return -speed / deceleration + travel_time(distance + back, 0.0, top_speed, acceleration, deceleration)
    speed = min(speed, top_speed)
    rise = (top_speed * top_speed - speed * speed) / (2.0 * acceleration)
    if distance <= rise:
        return (math.sqrt(speed * speed + 2.0 * acceleration * distance) - speed) / acceleration
    return (top_speed - speed) / acceleration + (distance - rise) / top_speed
