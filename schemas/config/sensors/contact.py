"""A bumper: in which sectors of its hull the robot touches another robot, an obstacle or the boundary."""

from dataclasses import dataclass
from typing import Annotated

from schemas.config.quantity import Choice, Quantity
from schemas.config.sensors.kinds import Reading, Sensor
from schemas.wire.part import Part
from schemas.wire.units import Seconds


@dataclass(frozen=True, slots=True, kw_only=True)
class Bumper(Sensor):
    """A bumper around the hull, in equal sectors counter-clockwise; the first one is centred on the kick axis.

    The ball and goals are not felt.
    """

    kind: Annotated[str, Choice("kind of the sensor", ("contact",))] = "contact"
    sectors: Annotated[int, Quantity("1", "number of sectors", 1, 64)] = 1
    gap: Annotated[float, Quantity("m", "what is as near as this is felt", 0, 0.1)] = 0.005
    rate: Annotated[float, Quantity("Hz", "readings per second; at most one in each tick", 0.1, 1000)] = 1000.0

    @property
    def size(self) -> int:
        """Values in a reading."""
        return self.sectors


class ContactReading(Part, Reading, tag_field="kind", tag="contact"):
    """What a bumper feels."""

    age: Seconds
    """Simulated time since the reading was taken, in s."""
    touched: list[bool]
    """Whether each sector touches something; the first is centred on the kick axis, the others follow
    counter-clockwise."""
