"""The ticks at which cameras take pictures, and the latency of the pictures."""

from dataclasses import dataclass
from fractions import Fraction

from schemas.config.sections import Sensing

_FINEST = 1_000_000
"""Largest denominator of the pictures in a tick as a fraction, so that a rounded 0.1 + 0.2 is three tenths again."""


@dataclass(frozen=True, slots=True)
class Shutter:
    """Pictures are numbered from 0, taken at tick 0; all cameras of a match take pictures in the same ticks."""

    pictures: int
    ticks: int
    """`pictures` are taken in `ticks` control ticks, as evenly as whole ticks allow."""
    latency: int
    """Ticks."""

    @classmethod
    def of(cls, sensing: Sensing, tick: float) -> "Shutter":
        """The shutter of a match whose control tick is `tick` s."""
        return cls.at_rate(sensing.camera_rate, tick, sensing.latency)

    @classmethod
    def at_rate(cls, rate: float, tick: float, latency: float = 0.0) -> "Shutter":
        """The shutter that is released `rate` times a second, where a control tick is `tick` s; `latency` in s."""
        each = min(Fraction(1), Fraction(rate * tick).limit_denominator(_FINEST))
        return cls(each.numerator, each.denominator, round(latency / tick))

    def number(self, tick: int) -> int:
        """The newest picture that was taken up to this tick."""
        return tick * self.pictures // self.ticks

    def tick_of(self, number: int) -> int:
        """The tick at which a picture is taken."""
        return -(-number * self.ticks // self.pictures)

    def takes(self, tick: int) -> bool:
        """Whether a picture is taken in this tick."""
        return self.tick_of(self.number(tick)) == tick
