"""Who keeps a side's goal: its first robot, and while that one is off the field, the next one that is on it."""

from collections.abc import Container, Sequence


def goalkeeper_of(robots: Sequence[str], off_field: Container[str]) -> str | None:
    """The robot that keeps the goal of a side that plays with a goalkeeper; nothing when all are off the field.

    Args:
        robots: those of the side, its goalkeeper first.
        off_field: who is off the field, sent off, in repair or not yet substituted.
    """
    return next((name for name in robots if name not in off_field), None)
