"""Clocks of robots that have been wholly outside the lines.

A clock runs while the robot is outside, and runs down while it is inside.
"""

from sim_host.soccer.referee.evidence.zones import Zones
from sim_host.soccer.referee.match_constants import MatchConstants


def outside_after(
    match: MatchConstants, before: tuple[tuple[int, float], ...], zones: Zones, dt: float
) -> tuple[tuple[int, float], ...]:
    """Robots by index, each with its clock in s, after one more tick of `dt` in s; those outside come first."""
    contact, known = match.book.contact, dict(before)
    running = [(index, known.pop(index, 0.0) + dt) for index in zones.outside]
    limit = contact.outside_duration
    rest = [(index, left) for index, lasted in known.items() if (left := min(lasted, limit) - dt) > 0.0]
    return (*running, *rest)
