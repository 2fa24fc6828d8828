"""A range finder: beams in one horizontal plane, each with the distance of the first body that it meets."""

import math
from dataclasses import dataclass
from typing import Annotated

from schemas.config.quantity import Choice, Quantity
from schemas.config.sensors.kinds import Reading, Sensor
from schemas.wire.part import Part
from schemas.wire.units import Metres, Radians, Seconds


@dataclass(frozen=True, slots=True, kw_only=True)
class RangeFinder(Sensor):
    """A range finder. The beams part the span evenly, each in the middle of its part; the own hull is transparent.

    They meet hulls of robots, obstacles, the boundary, and optionally the ball; goals are not seen. Noise is Gaussian,
    with the standard deviation √(noise² + (noise_share·distance)²), and cut off at four of them. A distance that is
    measured beyond the limits gives no return.
    """

    kind: Annotated[str, Choice("kind of the sensor", ("range",))] = "range"
    beams: Annotated[int, Quantity("1", "number of beams", 1, 720)]
    span: Annotated[float, Quantity("rad", "total angle that the beams cover", 0, math.tau)]
    max_distance: Annotated[float, Quantity("m", "a distance measured beyond it gives no return", 0.01, 200)]
    min_distance: Annotated[float, Quantity("m", "a distance measured below it gives no return", 0, 10)] = 0.0
    heading: Annotated[float, Quantity("rad", "kick axis to the middle of the span", -math.pi, math.pi)] = 0.0
    x: Annotated[float, Quantity("m", "place on the robot along the kick axis", -2, 2)] = 0.0
    y: Annotated[float, Quantity("m", "place on the robot to the left", -2, 2)] = 0.0
    height: Annotated[float, Quantity("m", "height of the beams above the ground", 0, 2)] = 0.1
    noise: Annotated[float, Quantity("m", "noise of a distance", 0, 5)] = 0.0
    noise_share: Annotated[float, Quantity("1", "further noise of a distance, as a share of it", 0, 1)] = 0.0
    dropout: Annotated[float, Quantity("1", "share of beams without a return", 0, 1)] = 0.0
    rate: Annotated[float, Quantity("Hz", "readings per second; at most one in each tick", 0.1, 1000)] = 1000.0
    ball: Annotated[str, Choice("whether beams meet the ball", ("seen", "unseen"))] = "unseen"

    @property
    def mount(self) -> tuple[float, float, float]:
        """Place on the robot in m."""
        return self.x, self.y, self.height

    @property
    def size(self) -> int:
        """Values in a reading."""
        return self.beams

    @property
    def angle_increment(self) -> float:
        """From one beam to the next, in rad."""
        return self.span / self.beams

    @property
    def angle_min(self) -> float:
        """From the kick axis to the first beam, counter-clockwise, in rad."""
        return self.heading + (self.angle_increment - self.span) / 2


class RangeReading(Part, Reading, tag_field="kind", tag="range"):
    """The distances that a range finder has measured; its place on the robot is in the setup of the match."""

    age: Seconds
    """Simulated time since the reading was taken, in s."""
    angle_min: Radians
    """From the robot's kick axis to the first beam, counter-clockwise, in rad."""
    angle_increment: Radians
    """From one beam to the next, counter-clockwise, in rad."""
    distances: list[Metres | None]
    """Along each beam, from the sensor, in m; None (null) without a return."""
