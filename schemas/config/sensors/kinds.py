"""What all kinds of sensors share: the bases of their numbers and readings, and how those are read by their `kind`."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from schemas.wire.json_schema import json_schema
from schemas.wire.part import convert


class Sensor:
    """The numbers of one sensor, which a frozen dataclass for each kind defines; all have these fields."""

    __slots__ = ()
    kind: str
    """The kind: a row of the table."""
    rate: float
    """Readings per second in Hz."""

    @property
    def mount(self) -> tuple[float, float, float]:
        """Place on the robot in m: x along the kick axis, y to the left, height above the ground."""
        return 0.0, 0.0, 0.0

    @property
    def size(self) -> int:
        """Number of values in a reading, each of at most nine bytes as JSON; messages have room for so many."""
        return 1

    @classmethod
    def model_validate(cls, content: Any) -> "Sensor":
        """The numbers in JSON content, of the kind that it names; `schemas.wire.part` calls this.

        Raises:
            ValueError: an unknown kind, or invalid numbers.
        """
        numbers: Sensor = convert(content, _kind_of(content).numbers)
        return numbers

    @classmethod
    def model_json_schema(cls, **_: Any) -> dict[str, Any]:
        """The JSON Schema of the numbers of any kind."""
        return {"anyOf": [json_schema(kind.numbers) for kind in KINDS.values()]}


class Reading:
    """A sensor's reading in a sight, which a part with the tag `kind` defines for each kind; all have these fields."""

    __slots__ = ()
    age: float
    """Simulated time since it was taken, in s."""

    @classmethod
    def model_validate(cls, content: Any) -> "Reading":
        """The reading in JSON content, of the kind that it names; `schemas.wire.part` calls this.

        Raises:
            ValueError: an unknown kind, or an invalid reading.
        """
        reading: Reading = convert(content, _kind_of(content).reading)
        return reading

    @classmethod
    def model_json_schema(cls, **_: Any) -> dict[str, Any]:
        """The JSON Schema of a reading of any kind."""
        return {"anyOf": [json_schema(kind.reading) for kind in KINDS.values()]}


class SensorKind(NamedTuple):
    """One kind of sensor."""

    numbers: type[Sensor]
    """A frozen dataclass; each field is annotated with a `Quantity` or a `Choice`."""
    reading: type[Reading]
    """A `schemas.wire.part.Part`."""


KINDS: dict[str, SensorKind] = {}
"""Kind → what it is; `schemas.config.sensors.table` has the rows."""


def _kind_of(content: Any) -> SensorKind:
    name = content.get("kind") if isinstance(content, Mapping) else None
    if name not in KINDS:
        raise ValueError(f"kind is {name!r}; one of {', '.join(KINDS)}")
    return KINDS[name]
