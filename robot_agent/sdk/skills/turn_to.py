"""Turn to a heading, braking in time."""

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.sdk.skills.braking import braking_speed
from schemas.frames import wrap
from schemas.messages.command import Drive

LAG = 0.08
"""s; how late the turn rate follows, with margin against the noise of the heading."""
_SHARE = 0.8
"""Part of the turn acceleration that braking counts on."""


def turn_rate(me: Moving, heading: float, limits: DriveLimits) -> float:
    """The turn rate in rad/s that ends at `heading` without passing it."""
    error = wrap(heading - me.heading)
    rate = min(limits.turn_rate, braking_speed(abs(error), _SHARE * limits.turn_acceleration, LAG))
    return rate if error >= 0.0 else -rate


def turn_to(me: Moving, heading: float, limits: DriveLimits) -> Drive:
    """Turn on the spot."""
    return Drive(omega=turn_rate(me, heading, limits))
