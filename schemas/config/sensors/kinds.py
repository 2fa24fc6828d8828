"""What all kinds of sensors share: the bases of their numbers and readings, and how those are read by their `kind`."""

from collections.abc import Mapping
from typing import Any, NamedTuple, Self

from schemas.wire.json_schema import json_schema
from schemas.wire.part import convert


class _OfKind:
    """A part of a message whose `kind` determines its type: `schemas.wire` calls these methods of its base."""

    __slots__ = ()
    kind: str
    """A row of the table."""

    @classmethod
    def kinds(cls) -> Mapping[str, type]:
        """Kind → the type of its parts."""
        raise NotImplementedError

    @classmethod
    def model_validate(cls, content: Any) -> Self:
        """The part in JSON content, of the kind that it names.

        Raises:
            ValueError: an unknown kind, or an invalid part.
        """
        name, kinds = content.get("kind") if isinstance(content, Mapping) else None, cls.kinds()
        if not isinstance(name, str) or name not in kinds:
            raise ValueError(f"kind is {name!r}; one of {', '.join(kinds)}")
        part: Self = convert(content, kinds[name])
        return part

    @classmethod
    def model_json_schema(cls, **_: Any) -> dict[str, Any]:
        """The JSON Schema of parts of all kinds; their fields are plain."""
        return {"anyOf": [json_schema(kind) for kind in cls.kinds().values()]}


class Sensor(_OfKind):
    """The numbers of one sensor, which a frozen dataclass for each kind defines; all have `kind` and `rate`."""

    __slots__ = ()
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
    def kinds(cls) -> Mapping[str, type]:
        """Kind → the type of its numbers."""
        return {name: kind.numbers for name, kind in KINDS.items()}


class Reading(_OfKind):
    """A sensor's reading in a sight, which a part with the tag `kind` defines for each kind; all have `age`."""

    __slots__ = ()
    age: float
    """Simulated time since it was taken, in s."""

    @classmethod
    def kinds(cls) -> Mapping[str, type]:
        """Kind → the type of its readings."""
        return {name: kind.reading for name, kind in KINDS.items()}


class SensorKind(NamedTuple):
    """One kind of sensor."""

    numbers: type[Sensor]
    """A frozen dataclass; each field is annotated with a `Quantity` or a `Choice`."""
    reading: type[Reading]
    """A `schemas.wire.part.Part`."""


KINDS: dict[str, SensorKind] = {}
"""Kind → what it is; `schemas.config.sensors.table` has the rows."""
