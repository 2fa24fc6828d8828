"""Number types with a unit, which error messages name; infinity and NaN are no such numbers."""

import sys
from typing import Annotated

from msgspec import Meta

MAX = sys.float_info.max
"""The limit of numbers without another one: JSON has no infinity and no NaN, but a program's arithmetic has."""
MAX_WHOLE = 2**53 - 1
"""The largest whole number that every language reads exactly from JSON."""
Finite = Annotated[float, Meta(ge=-MAX, le=MAX)]
Metres = Annotated[float, Meta(ge=-MAX, le=MAX, extra={"unit": "m"})]
MetresPerSecond = Annotated[float, Meta(ge=-MAX, le=MAX, extra={"unit": "m/s"})]
Radians = Annotated[float, Meta(ge=-MAX, le=MAX, extra={"unit": "rad"})]
RadiansPerSecond = Annotated[float, Meta(ge=-MAX, le=MAX, extra={"unit": "rad/s"})]
Seconds = Annotated[float, Meta(ge=-MAX, le=MAX, extra={"unit": "s"})]
Age = Annotated[float, Meta(ge=0, le=MAX, extra={"unit": "s"})]
