"""Faults of parts of messages, in the words of `faults`; the errors of msgspec lack the value and what was expected."""

import dataclasses
import types
from collections.abc import Iterable, Mapping, Sequence
from enum import Enum
from typing import Annotated, Any, Literal, TypeVar, Union, cast, get_args, get_origin

import msgspec
from pydantic import BaseModel, ValidationError
from pydantic_core import from_json

from schemas.wire.faults import PLAIN_TYPES, Fault, FaultError, FaultKind, hints_of, not_json
from schemas.wire.model_faults import fault_of, without_jargon
from schemas.wire.part import convert, decoder
from schemas.wire.units import MAX

T = TypeVar("T")


def validated(kind: type[T], content: Mapping[str, Any]) -> T:
    """A message, a part or a model with this content.

    Raises:
        FaultError: the content is invalid.
    """
    try:
        return cast(T, convert(content, kind))
    except msgspec.ValidationError:
        raise FaultError(fault_of_content(kind, content)) from None


def decoded(kind: Any, payload: bytes | str) -> Any:
    """The value of a type, or of one of several in a union, in JSON.

    Raises:
        FaultError: not JSON, or not such a value.
    """
    try:
        return decoder(kind).decode(payload)
    except (ValueError, RecursionError):
        raise FaultError(fault_of_payload(kind, payload)) from None


def fault_of_payload(kind: Any, payload: bytes | str) -> Fault:
    """The fault of JSON that is not a value of a type."""
    try:
        content = from_json(payload)
    except ValueError as reason:
        return not_json(payload, reason)
    return fault_of_content(kind, content)


def fault_of_content(kind: Any, content: Any) -> Fault:
    """The fault of content that is not a value of a type."""
    return fault_in(kind, content) or Fault((), None, "cannot be read", FaultKind.RULE)


def fault_in(hint: Any, value: Any) -> Fault | None:
    """The first fault of a value for a field or a part of this type; None where it has none.

    Slow, for explanations only: the error of msgspec names neither the entry of a mapping nor the valid values.
    """
    kind, inner = get_origin(hint), get_args(hint)
    if kind is Annotated and get_origin(inner[0]) is not None:
        return fault_in(inner[0], value) or _leaf(hint, value)
    if kind in (Union, types.UnionType):
        return _of_choices(hint, [choice for choice in inner if choice is not types.NoneType], value)
    if isinstance(hint, type) and (issubclass(hint, msgspec.Struct) or dataclasses.is_dataclass(hint)):
        return _of_part(hint, value)
    if isinstance(hint, type) and issubclass(hint, BaseModel):
        return _of_model(hint, value)
    if isinstance(hint, type) and hasattr(hint, "kinds"):
        return _of_named("kind", hint.kinds(), value)
    if kind is list and isinstance(value, Sequence) and not isinstance(value, str):
        return _first((place, fault_in(inner[0], item)) for place, item in enumerate(value))
    if kind is dict and isinstance(value, Mapping):
        keys = ((str(name), fault_in(inner[0], name)) for name in value)
        return _first(keys) or _first((str(name), fault_in(inner[1], item)) for name, item in value.items())
    return None if hint is msgspec.Raw else _leaf(hint, value)


def expected(hint: Any) -> str:
    """The valid values of a field of this type, in words: `m/s from -20 to 20`."""
    kind, inner = get_origin(hint), get_args(hint)
    if kind is Annotated:
        return _limited(inner[0], [one for one in inner[1:] if isinstance(one, msgspec.Meta)])
    if kind in (Union, types.UnionType):
        implied = {types.NoneType, int} if any(float in (one, *get_args(one)) for one in inner) else {types.NoneType}
        return " or ".join(expected(choice) for choice in inner if choice not in implied)
    if kind is Literal:
        return f"one of {', '.join(map(str, inner))}"
    if isinstance(hint, type) and issubclass(hint, Enum):
        return f"one of {', '.join(str(member.value) for member in hint)}"
    return PLAIN_TYPES.get(hint, "a list" if kind is list else "an object")


def _first(faults: Iterable[tuple[str | int, Fault | None]]) -> Fault | None:
    return next((fault.below((step,)) for step, fault in faults if fault is not None), None)


def _of_part(kind: type, value: Any) -> Fault | None:
    """The first unknown, missing or invalid field; then the rules over several fields."""
    if isinstance(value, kind):
        value = msgspec.to_builtins(value, enc_hook=dict)
    if not isinstance(value, Mapping):
        return Fault((), value, expected(kind))
    hints, required = hints_of(kind), _required(kind)
    if issubclass(kind, msgspec.Struct):
        known = kind.__struct_fields__
        for name in value:
            if name not in (*known, kind.__struct_config__.tag_field):
                return Fault((str(name),), value[name], "", FaultKind.UNKNOWN, known)
    for name in required:
        if name not in value:
            return Fault((name,), None, "", FaultKind.MISSING)
    fault = _first((name, fault_in(hints[name], item)) for name, item in value.items() if name in hints)
    return fault or _rule(kind, value)


def _required(kind: Any) -> list[str]:
    """The fields without a default."""
    if issubclass(kind, msgspec.Struct):
        return [field.name for field in msgspec.structs.fields(kind) if field.required]
    none = dataclasses.MISSING
    return [field.name for field in dataclasses.fields(kind) if field.default is field.default_factory is none]


def _rule(kind: type, content: Mapping[str, Any]) -> Fault | None:
    try:
        convert(content, kind)
    except msgspec.ValidationError as error:
        words = str(error.__cause__) if error.__cause__ else without_jargon(str(error).partition(" - at ")[0])
        return Fault((), None, words, FaultKind.RULE)
    return None


def _of_model(kind: type[BaseModel], value: Any) -> Fault | None:
    try:
        kind.model_validate(value)
    except ValidationError as error:
        return fault_of(error, kind)
    return None


def _of_choices(hint: Any, choices: Sequence[Any], value: Any) -> Fault | None:
    if len(choices) == 1:
        return None if value is None else fault_in(choices[0], value)
    if all(isinstance(one, type) and issubclass(one, msgspec.Struct) for one in choices):
        field = str(choices[0].__struct_config__.tag_field)
        return _of_named(field, {str(one.__struct_config__.tag): one for one in choices}, value)
    return None if any(fault_in(choice, value) is None for choice in choices) else Fault((), value, expected(hint))


def _of_named(field: str, kinds: Mapping[str, type], value: Any) -> Fault | None:
    """The first fault of a value that is one of several parts, which a field of it names."""
    if not isinstance(value, Mapping):
        return Fault((), value, "an object")
    if field not in value:
        return Fault((field,), None, "", FaultKind.MISSING)
    chosen = kinds.get(str(value[field]))
    return fault_in(chosen, value) if chosen else Fault((field,), value[field], f"one of {', '.join(kinds)}")


def _leaf(hint: Any, value: Any) -> Fault | None:
    try:
        convert(value, hint)
    except msgspec.ValidationError:
        return Fault((), value, expected(hint))
    return None


def _limited(kind: Any, limits: Sequence[msgspec.Meta]) -> str:
    """A type with limits, in words."""
    declared = {
        key: value for one in limits for key in _LIMITS if (value := getattr(one, key)) not in (None, MAX, -MAX)
    }
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
