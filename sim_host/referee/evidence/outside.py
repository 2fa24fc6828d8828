"""Durations for which robots have been wholly outside the lines."""

from sim_host.referee.evidence.zones import Zones


def outside_after(before: tuple[tuple[int, float], ...], zones: Zones, dt: float) -> tuple[tuple[int, float], ...]:
    """Robots outside, by index, each with its duration in s, after one more tick of `dt` in s."""
    known = dict(before)
    return tuple([(index, known.get(index, 0.0) + dt) for index in zones.outside])
