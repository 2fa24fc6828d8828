"""A compass: the robot's heading in the field frame."""

from dataclasses import dataclass
from typing import Annotated

from schemas.config.quantity import Choice, Quantity
from schemas.config.sensors.kinds import Reading, Sensor
from schemas.wire.part import Part
from schemas.wire.units import Radians, Seconds


@dataclass(frozen=True, slots=True, kw_only=True)
class Compass(Sensor):
    """A compass. Noise and drift are Gaussian and given as standard deviations."""

    kind: Annotated[str, Choice("kind of the sensor", ("compass",))] = "compass"
    noise: Annotated[float, Quantity("rad", "noise of the heading, independent in each reading", 0, 3.2)] = 0.0
    bias: Annotated[float, Quantity("rad", "constant error of the heading", -3.2, 3.2)] = 0.0
    drift: Annotated[float, Quantity("rad", "wandering error of the heading", 0, 3.2)] = 0.0
    drift_time: Annotated[
        float, Quantity("s", "time after which the drift is independent of its earlier value", 0.1, 1e4)
    ] = 60.0
    rate: Annotated[float, Quantity("Hz", "readings per second; at most one in each tick", 0.1, 1000)] = 1000.0


class CompassReading(Part, Reading, tag_field="kind", tag="compass"):
    """The heading that a compass shows. It knows no team: a robot that attacks −x shows about π toward that goal."""

    age: Seconds
    """Simulated time since the reading was taken, in s."""
    heading: Radians
    """Kicking direction in the field frame, counter-clockwise from +x, in (−π, π], in rad."""
