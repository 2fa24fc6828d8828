"""One sensor of a profile on all robots that carry it, and what a kind of sensor has to implement."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Protocol

from schemas.config.sections import Pitch
from schemas.config.sensors.table import Reading
from sim_host.sensing.random_streams import BatchedDraws, Floats, RandomStreams, StreamId
from sim_host.sensing.shutter import Shutter
from sim_host.snapshot import Roster, Snapshot

_BATCH = 16
"""Readings for which draws are made at a time: thousands of numbers a reading leave the caches with more."""


@dataclass(frozen=True, slots=True)
class Carried:
    """A sensor with the same numbers on several robots."""

    name: str
    """Name of the sensor in the profile."""
    numbers: Any
    """Its numbers: of the class that the table of `schemas.config.sensors` has for its kind."""
    robots: tuple[int, ...]
    """Indices of the robots in the roster."""
    roster: Roster
    pitch: Pitch
    ball_radius: float
    """m."""
    tick: float
    """Length of a control tick, s."""
    shutter: Shutter
    """The ticks in which it is read; readings are numbered from 0."""
    streams: RandomStreams

    def normals(self, count: int) -> BatchedDraws[Floats]:
        """Standard normal numbers by number of the reading, shape (robots, count)."""
        return self._draws(self.streams.normals, self._keys("normal"), count)

    def errors(self, count: int, lost: float) -> BatchedDraws[Floats]:
        """The same of `RandomStreams.errors`: NaN for a share `lost` of them."""
        return self._draws(partial(self.streams.errors, lost=lost), self._keys("error"), count)

    def _draws(self, draw: Callable[..., Floats], keys: list[str], count: int) -> BatchedDraws[Floats]:
        def of(numbers: range) -> list[Floats]:
            return list(draw(StreamId.SENSOR, keys, [self.shutter.tick_of(number) for number in numbers], count))

        return BatchedDraws(of, _BATCH)

    def knots(self, numbers: Sequence[int]) -> Floats:
        """A standard normal number for each of these whole numbers, shape (numbers, robots)."""
        return self.streams.normals(StreamId.SENSOR, self._keys("knot"), numbers, 1)[:, :, 0]

    def _keys(self, use: str) -> list[str]:
        return [f"{self.roster.names[place]}/{self.name}/{use}" for place in self.robots]


class ComputedSensor(Protocol):
    """What a kind of sensor implements. It keeps no state that a reading depends on: any tick may be read first."""

    def __init__(self, carried: Carried) -> None:
        """Compute what all readings share."""

    def read(self, snapshot: Snapshot, number: int) -> Sequence[Reading]:
        """A reading for each robot that carries the sensor, of age 0; `number` is that of the reading."""
