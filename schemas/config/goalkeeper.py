"""The goalkeeper of a side: its first robot, or while that is off the field, the next one on the field."""

from collections.abc import Container, Sequence


def goalkeeper_of(robots: Sequence[str], off_field: Container[str]) -> str | None:
    """The goalkeeper of a side that plays with one; None while all its robots are off the field.

    Args:
        robots: the robots of the side, its goalkeeper first.
        off_field: robots that are off the field: sent off, in repair, or waiting as substitutes.
    """
    return next((name for name in robots if name not in off_field), None)
