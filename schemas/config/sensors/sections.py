"""Reads the sensors of a profile, `[robot.sensors.NAME]`, and of its types, `[types.TYPE.sensors.NAME]`."""

import dataclasses
import math
from collections.abc import Mapping
from typing import Any

from schemas.config.quantity import meanings, read_changes
from schemas.config.sections import RobotBody
from schemas.config.sensors.table import KINDS, Sensor
from schemas.errors import TouchlineError, did_you_mean
from schemas.wire.message import is_name

Sensors = Mapping[str, Sensor]
"""Name → sensor, of one type of robot."""
MOST_VALUES = 500
"""Most values in the readings of one robot: with 22 robots, a world stays within its `max_bytes`."""
_VALUES_OF_A_NAME = 20
"""As many values have the bytes of a reading's name, kind and age."""


def read_sensors(tables: Any, where: str, section: str, origins: dict[str, str], inherited: Sensors) -> Sensors:
    """The sensors in the tables below `section` of a file, after those `inherited`, of which numbers may be changed.

    Raises:
        TouchlineError: an unknown kind or key, a missing or an invalid number; names the place.
    """
    sensors = dict(inherited)
    for name, table in _table(tables, f"{where}: {section}").items():
        at = f"{section}.{name}"
        if not is_name(name):
            raise TouchlineError(f"{where}: {at} is no name; write lower-case letters, digits and _")
        sensors[name] = _read(dict(_table(table, f"{where}: {at}")), where, at, origins, inherited.get(name))
    return sensors


def _table(content: Any, at: str) -> dict[str, Any]:
    if not isinstance(content, dict):
        raise TouchlineError(f'{at} is {content!r}; write a table: kind = "range", and its numbers')
    return content


def _read(table: dict[str, Any], where: str, at: str, origins: dict[str, str], before: Sensor | None) -> Sensor:
    kind = table.pop("kind", before.kind if before is not None else None)
    if not isinstance(kind, str) or kind not in KINDS:
        given = "missing" if kind is None else repr(kind)
        raise TouchlineError(f"{where}: {at}.kind is {given}; {did_you_mean(kind, KINDS)}")
    numbers: Any = KINDS[kind].numbers
    values = read_changes(numbers, table, where, at, origins)
    if before is not None and before.kind == kind:
        return dataclasses.replace(before, **values)  # type: ignore[type-var]
    for field in dataclasses.fields(numbers):
        if field.default is dataclasses.MISSING and field.name not in values:
            unit = getattr(meanings(numbers)[field.name], "unit", "")
            raise TouchlineError(
                f'{where}: {at}.{field.name} is missing; add {{ value = …, unit = "{unit}", origin = "…" }}'
            )
    sensor: Sensor = numbers(**values)
    return sensor


def check_mounted(sensors: Sensors, body: RobotBody, at: str) -> None:
    """Check that all sensors of a robot are within its hull, and that messages have room for their readings.

    `at` is the place of the sensors in a file.

    Raises:
        TouchlineError: one is outside, or they have too many values.
    """
    values = sum(sensor.size + _VALUES_OF_A_NAME for sensor in sensors.values())
    if values > MOST_VALUES:
        raise TouchlineError(
            f"{at}: the readings of {', '.join(sensors)} have {values} values, {_VALUES_OF_A_NAME} for each sensor "
            f"included; at most {MOST_VALUES}: give them fewer beams or sectors"
        )
    for name, sensor in sensors.items():
        x, y, height = sensor.mount
        if math.hypot(x, y) > body.reach or height > body.height:
            raise TouchlineError(
                f"{at}.{name} is at x {x:g} m, y {y:g} m, height {height:g} m, outside its robot; the hull reaches "
                f"{body.reach:.3g} m from the axis and is {body.height:g} m high"
            )
