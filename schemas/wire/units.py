"""Number types with a unit, which error messages name."""

from typing import Annotated

from msgspec import Meta

Metres = Annotated[float, Meta(extra={"unit": "m"})]
MetresPerSecond = Annotated[float, Meta(extra={"unit": "m/s"})]
Radians = Annotated[float, Meta(extra={"unit": "rad"})]
RadiansPerSecond = Annotated[float, Meta(extra={"unit": "rad/s"})]
Seconds = Annotated[float, Meta(extra={"unit": "s"})]
Age = Annotated[float, Meta(ge=0, extra={"unit": "s"})]
