"""The resolution of the sensors, in arrays."""

from schemas.messages.percept import DIGITS
from sim_host.sensing.random_streams import Floats


def rounded(numbers: Floats) -> Floats:
    """Perceived numbers with these digits; zero has no sign, which would reveal the half of the field."""
    digits: Floats = numbers.round(DIGITS)
    digits += 0.0
    return digits
