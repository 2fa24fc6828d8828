"""Numbers with unit, range and origin: how profiles and rule books are read from TOML.

A number in a data file is a table, `{ value = 22.0, unit = "m", origin = "rule book 24.1, A" }`. The dataclass
that receives it says, per field, which unit it must have and which range makes sense.
"""

import math
import typing
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

from schemas.errors import TouchlineError, did_you_mean

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Quantity:
    """What a number means: its unit, its sentence, and the range in which it makes sense."""

    unit: str
    meaning: str
    low: float = -math.inf
    high: float = math.inf

    @property
    def description(self) -> str:
        """The sentence with the unit."""
        return self.meaning if self.unit == "1" else f"{self.meaning}; {self.unit}"

    def __get_pydantic_json_schema__(self, schema: Any, handler: Callable[[Any], dict[str, Any]]) -> dict[str, Any]:
        """The JSON Schema of a field of this meaning."""
        return {**handler(schema), "description": self.description}


@dataclass(frozen=True, slots=True)
class Choice:
    """A word out of a closed set, and what it chooses."""

    meaning: str
    options: tuple[str, ...]

    @property
    def description(self) -> str:
        """The sentence with the words."""
        return f"{self.meaning}: {', '.join(self.options)}"

    def __get_pydantic_json_schema__(self, schema: Any, handler: Callable[[Any], dict[str, Any]]) -> dict[str, Any]:
        """The JSON Schema of a field of this meaning."""
        return {**handler(schema), "description": self.description}


def meanings(section: type) -> dict[str, Quantity | Choice]:
    """The meaning of each field of a section, in order."""
    hints = get_type_hints(section, include_extras=True)
    return {field.name: get_args(hints[field.name])[1] for field in fields(section)}


def read_section(section: type[T], table: dict[str, Any], where: str, origins: dict[str, str]) -> T:
    """Fill a dataclass from a TOML table and collect each number's origin under `where.key`.

    Raises:
        TouchlineError: an unknown or missing key, a wrong unit, type or range; names place, value and remedy.
    """
    for key in meanings(section):
        if key not in table:
            raise TouchlineError(f"{where}.{key} is missing; add it, or extend a profile that has it")
    return section(**read_changes(section, table, where, origins))


def read_changes(section: type, table: dict[str, Any], where: str, origins: dict[str, str]) -> dict[str, Any]:
    """The values of those keys of a section that a TOML table gives, checked, in the section's order.

    Raises:
        TouchlineError: an unknown key, a wrong unit, type or range; names place, value and remedy.
    """
    known = meanings(section)
    if not isinstance(table, dict):
        raise TouchlineError(f"{where} is {table!r}; write a table of numbers")
    for key in table:
        if key not in known:
            raise TouchlineError(f"{where}.{key} is not known; {did_you_mean(key, known)}")
    hints = get_type_hints(section)
    values = {}
    for key, meaning in known.items():
        if key not in table:
            continue
        at = f"{where}.{key}"
        entry = table[key]
        if not isinstance(entry, dict) or set(entry) - {"value", "unit", "origin"} or "origin" not in entry:
            raise TouchlineError(f'{at} is {entry!r}; write {{ value = …, unit = "…", origin = "…" }}')
        origins[at] = str(entry["origin"])
        values[key] = _check_entry(entry, meaning, hints[key], at)
    return values


def _check_entry(entry: dict[str, Any], meaning: Quantity | Choice, kind: Any, at: str) -> Any:
    if isinstance(meaning, Quantity) and entry.get("unit") != meaning.unit:
        raise TouchlineError(f'{at} has unit {entry.get("unit")!r}; it is given in "{meaning.unit}"')
    return check_value(entry.get("value"), meaning, kind, at)


def check_value(value: Any, meaning: Quantity | Choice, kind: Any, at: str) -> Any:
    """A value as its field of that type keeps it; `at` names the place in the sentence of an error.

    Raises:
        TouchlineError: a wrong type, a number out of range, a word that is not known.
    """
    if isinstance(meaning, Choice):
        if value not in meaning.options:
            raise TouchlineError(f"{at} is {value!r}; {did_you_mean(str(value), meaning.options)}")
        return value
    if get_origin(kind) is tuple:
        if not isinstance(value, list):
            raise TouchlineError(f"{at} is {value!r}; write a list of numbers")
        return tuple(_number(item, meaning, at) for item in value)
    number = _number(value, meaning, at)
    if kind is int:
        if number != int(number):
            raise TouchlineError(f"{at} is {value!r}; write a whole number")
        return int(number)
    return number


def _number(value: Any, meaning: Quantity, at: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise TouchlineError(f"{at} is {value!r}; write a number in {meaning.unit}")
    if not meaning.low <= value <= meaning.high:
        unit = "" if meaning.unit == "1" else f" {meaning.unit}"
        raise TouchlineError(f"{at} is {value}; it lies between {meaning.low:g} and {meaning.high:g}{unit}")
    return float(value)


def merge_tables(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """A file's tables laid over those it extends, key by key, down to the numbers, which are replaced whole."""
    merged: dict[str, Any] = dict(base)
    for name, part in changes.items():
        below = merged.get(name)
        is_table = isinstance(part, dict) and isinstance(below, dict) and "value" not in below
        merged[name] = merge_tables(typing.cast("dict[str, Any]", below), part) if is_table else part
    return merged
