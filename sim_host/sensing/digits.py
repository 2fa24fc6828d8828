"""The resolution of the sensors."""

from sim_host.sensing.random_streams import Floats

DIGITS = 4
"""Decimal places of all perceived numbers: 0.1 mm is below any sensor's noise, and halves the bytes of a sight."""


def rounded(numbers: Floats) -> Floats:
    """Perceived numbers with these digits; zero has no sign, which would reveal the half of the field."""
    digits: Floats = numbers.round(DIGITS)
    digits += 0.0
    return digits
