"""The order of names with numbers: cyan2 comes before cyan10."""

import re

_NUMBER = re.compile(r"(\d+)")


def natural_order(name: str) -> tuple[tuple[int, str], ...]:
    """Key for sorting names or topic keys: digits count as numbers."""
    return tuple((int(part), part) if part.isdecimal() else (-1, part) for part in _NUMBER.split(name))
