"""Faults of msgspec structs, in the words of `faults`; the errors of msgspec lack the value and what was expected."""

import math
import types
from collections.abc import Iterable, Mapping, Sequence
from enum import Enum
from typing import Annotated, Any, TypeVar, Union, cast, get_args, get_origin

import msgspec
from pydantic import BaseModel, ValidationError

from schemas.wire.faults import PLAIN_TYPES, Fault, FaultError, FaultKind, fault_of, hints_of, without_jargon

T = TypeVar("T")


def validated(kind: type[T], content: Mapping[str, Any]) -> T:
    """A message or a part, model or struct, with this content.

    Raises:
        FaultError: the content is invalid.
    """
    if issubclass(kind, BaseModel):
        try:
            return cast(T, kind.model_validate(content))
        except ValidationError as error:
            raise FaultError(fault_of(error, kind)) from None
    try:
        return msgspec.convert(content, kind)
    except msgspec.ValidationError as error:
        raise FaultError(fault_in(kind, content) or _msgspec_fault(error)) from None


def fault_in(hint: Any, value: Any) -> Fault | None:
    """The first fault of a value for a field or a struct of this type; None where it has none.

    Slow, for explanations only: the error of msgspec names neither the entry of a mapping nor the valid values.
    """
    kind, inner = get_origin(hint), get_args(hint)
    if kind is Annotated and get_origin(inner[0]) is not None:
        return fault_in(inner[0], value) or _leaf(hint, value)
    if kind in (Union, types.UnionType):
        return _of_choices(hint, [choice for choice in inner if choice is not types.NoneType], value)
    if isinstance(hint, type) and issubclass(hint, msgspec.Struct):
        return _of_struct(hint, value)
    if kind is list and isinstance(value, Sequence) and not isinstance(value, str):
        return _first((place, fault_in(inner[0], item)) for place, item in enumerate(value))
    if kind is dict and isinstance(value, Mapping):
        keys = ((str(name), fault_in(inner[0], name)) for name in value)
        return _first(keys) or _first((str(name), fault_in(inner[1], item)) for name, item in value.items())
    return _leaf(hint, value)


def expected(hint: Any) -> str:
    """The valid values of a field of this type, in words: `m/s from -20 to 20`."""
    kind, inner = get_origin(hint), get_args(hint)
    if kind is Annotated:
        return _limited(inner[0], [one for one in inner[1:] if isinstance(one, msgspec.Meta)])
    if kind in (Union, types.UnionType):
        implied = {types.NoneType, int} if float in inner else {types.NoneType}
        return " or ".join(expected(choice) for choice in inner if choice not in implied)
    if isinstance(hint, type) and issubclass(hint, Enum):
        return f"one of {', '.join(str(member.value) for member in hint)}"
    return PLAIN_TYPES.get(hint, "a list" if kind is list else "an object")


def _msgspec_fault(error: Exception) -> Fault:
    """The fault in the words of msgspec's error."""
    return Fault((), None, without_jargon(str(error).partition(" - at ")[0]), FaultKind.RULE)


def _first(faults: Iterable[tuple[str | int, Fault | None]]) -> Fault | None:
    return next((fault.below((step,)) for step, fault in faults if fault is not None), None)


def _of_struct(kind: type[msgspec.Struct], value: Any) -> Fault | None:
    """The first unknown, missing or invalid field; then the rules over several fields."""
    if isinstance(value, kind):
        value = msgspec.structs.asdict(value)
    if not isinstance(value, Mapping):
        return Fault((), value, expected(kind))
    hints = hints_of(kind)
    for name in value:
        if name not in kind.__struct_fields__:
            return Fault((str(name),), value[name], "", FaultKind.UNKNOWN, kind.__struct_fields__)
    for field in msgspec.structs.fields(kind):
        if field.name not in value and field.required:
            return Fault((field.name,), None, "", FaultKind.MISSING)
    fault = _first((name, fault_in(hints[name], item)) for name, item in value.items())
    return fault or _rule(kind, value)


def _rule(kind: type[msgspec.Struct], content: Mapping[str, Any]) -> Fault | None:
    try:
        msgspec.convert(content, kind)
    except msgspec.ValidationError as error:
        cause = error.__cause__
        return cause.fault if isinstance(cause, FaultError) else _msgspec_fault(error)
    return None


def _of_choices(hint: Any, choices: Sequence[Any], value: Any) -> Fault | None:
    if len(choices) == 1:
        return None if value is None else fault_in(choices[0], value)
    return None if any(fault_in(choice, value) is None for choice in choices) else Fault((), value, expected(hint))


def _leaf(hint: Any, value: Any) -> Fault | None:
    try:
        converted = msgspec.convert(value, hint)
    except msgspec.ValidationError:
        return Fault((), value, expected(hint))
    is_finite = not isinstance(converted, float) or math.isfinite(converted)
    return None if is_finite else Fault((), value, expected(hint))


def _limited(kind: Any, limits: Sequence[msgspec.Meta]) -> str:
    """A type with limits, in words."""
    declared = {key: value for one in limits for key in _LIMITS if (value := getattr(one, key)) is not None}
    unit = next((one.extra["unit"] for one in limits if one.extra and "unit" in one.extra), "")
    if "description" in declared:
        return str(declared["description"])
    if kind not in (int, float):
        most = declared.get("max_length")
        return expected(kind) + (
            "" if most is None else f" of at most {most} {'characters' if kind is str else 'entries'}"
        )
    low, high = declared.get("ge"), declared.get("le")
    words = [] if low is None else [f"from {_figure(low)}"]
    words += [f"above {_figure(declared['gt'])}"] if "gt" in declared else []
    if high is not None:
        words.append(f"to {_figure(high)}" if low is not None else f"at most {_figure(high)}")
    if not words:
        return f"{PLAIN_TYPES[kind]} in {unit}" if unit else PLAIN_TYPES[kind]
    noun = unit or ("a whole number" if kind is int else "a number")
    return f"{noun} {(' ' if low is not None else ', ').join(words)}"


def _figure(number: float) -> str:
    return str(number) if isinstance(number, int) else f"{number:g}"


_LIMITS = ("ge", "gt", "le", "max_length", "description")
