"""Numbers with unit, range and origin: how profiles and rule books are read from TOML.

A number in a data file is a table, `{ value = 22.0, unit = "m", origin = "rule book 24.1, A" }`. The dataclass that
receives it declares the unit and the sensible range of each field.
"""

import math
import typing
from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cache
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

from schemas.errors import TouchlineError, did_you_mean

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Quantity:
    """The meaning of a number: its unit, a phrase, and its sensible range."""

    unit: str
    meaning: str
    low: float = -math.inf
    high: float = math.inf

    @property
    def description(self) -> str:
        """The phrase with the unit."""
        return self.meaning if self.unit == "1" else f"{self.meaning}; {self.unit}"

    def __get_pydantic_json_schema__(self, schema: Any, handler: Callable[[Any], dict[str, Any]]) -> dict[str, Any]:
        """The JSON Schema of a field of this meaning."""
        return {**handler(schema), "description": self.description}


@dataclass(frozen=True, slots=True)
class Choice:
    """The meaning of a word from a closed set."""

    meaning: str
    options: tuple[str, ...]

    @property
    def description(self) -> str:
        """The phrase with the words."""
        return f"{self.meaning}: {', '.join(self.options)}"

    def __get_pydantic_json_schema__(self, schema: Any, handler: Callable[[Any], dict[str, Any]]) -> dict[str, Any]:
        """The JSON Schema of a field of this meaning."""
        return {**handler(schema), "description": self.description}


@cache
def meanings(section: type) -> dict[str, Quantity | Choice]:
    """The meaning of each field of a section, in order."""
    hints = get_type_hints(section, include_extras=True)
    return {field.name: get_args(hints[field.name])[1] for field in fields(section)}


@cache
def _types(section: type) -> dict[str, Any]:
    """The type of each field of a section."""
    return get_type_hints(section)


def read_section(section: type[T], table: dict[str, Any], file: str, name: str, origins: dict[str, str]) -> T:
    """The dataclass of the TOML table `name` of a file; the origin of each number is added to `origins`, by `name.key`.

    Raises:
        TouchlineError: an unknown or missing key, or an invalid unit, type or range; names place, value and remedy.
    """
    for key in meanings(section):  # type: ignore[arg-type]  # a type can be hashed
        if key not in table:
            raise TouchlineError(f"{file}: {name}.{key} is missing; add it, or extend a profile that has it")
    return section(**read_changes(section, table, file, name, origins))


def read_changes(section: type, table: dict[str, Any], file: str, name: str, origins: dict[str, str]) -> dict[str, Any]:
    """The checked values of the keys in a TOML table of a section, in the section's order.

    Raises:
        TouchlineError: an unknown key, or an invalid unit, type or range; names place, value and remedy.
    """
    known, where = meanings(section), f"{file}: {name}"
    if not isinstance(table, dict):
        raise TouchlineError(f"{where} is {table!r}; write a table of numbers")
    for key in table:
        if key not in known:
            raise TouchlineError(f"{where}.{key} is not known; {did_you_mean(key, known)}")
    hints = _types(section)
    values = {}
    for key, meaning in known.items():
        if key not in table:
            continue
        at = f"{where}.{key}"
        entry = table[key]
        if not isinstance(entry, dict) or set(entry) - {"value", "unit", "origin"} or "origin" not in entry:
            raise TouchlineError(f'{at} is {entry!r}; write {{ value = …, unit = "…", origin = "…" }}')
        origins[f"{name}.{key}"] = str(entry["origin"])
        values[key] = _check_entry(entry, meaning, hints[key], at)
    return values


def _check_entry(entry: dict[str, Any], meaning: Quantity | Choice, kind: Any, at: str) -> Any:
    if isinstance(meaning, Quantity) and entry.get("unit") != meaning.unit:
        raise TouchlineError(f'{at} has unit {entry.get("unit")!r}; its unit is "{meaning.unit}"')
    return check_value(entry.get("value"), meaning, kind, at)


def check_value(value: Any, meaning: Quantity | Choice, kind: Any, at: str) -> Any:
    """A value converted to the type of its field; `at` names the place in error messages.

    Raises:
        TouchlineError: an invalid type, a number out of range, or an unknown word.
    """
    if isinstance(meaning, Choice):
        if value not in meaning.options:
            raise TouchlineError(f"{at} is {value!r}; {did_you_mean(value, meaning.options)}")
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
        raise TouchlineError(f"{at} is {value}; it must be between {meaning.low:g} and {meaning.high:g}{unit}")
    return float(value)


def merge_tables(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Tables merged into those that they extend, key by key; a number is replaced as a whole."""
    merged: dict[str, Any] = dict(base)
    for name, part in changes.items():
        below = merged.get(name)
        is_table = isinstance(part, dict) and isinstance(below, dict) and "value" not in below
        merged[name] = merge_tables(typing.cast("dict[str, Any]", below), part) if is_table else part
    return merged
