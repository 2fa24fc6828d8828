"""Messages and parts that are written and read in every tick: msgspec structs, whose annotations hold their limits.

A robot's process is woken for each sight, when nine others have been at the caches since: what it touches is what it
costs, and a struct keeps its fields and nothing else. A struct can be a field of a pydantic model, and is validated,
written and described there as everywhere.
"""

import math
import re
import sys
from collections.abc import Callable
from enum import Enum
from functools import cache, partial
from types import NoneType, UnionType
from typing import Annotated, Any, ClassVar, NamedTuple, Self, TypeVar, Union, cast, get_args, get_origin

import msgspec
from msgspec import Meta
from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema, from_json

from schemas.faults import Fault, FaultError, FaultKind, fault_in, hints_of, not_json, validated
from schemas.json_schema import in_one_piece, published
from schemas.message import VERSION, decoded

encode = msgspec.json.Encoder(enc_hook=dict).encode
"""Structs, models, dataclasses and mappings of them as UTF-8 JSON; floats keep every bit, and NaN is null."""

T = TypeVar("T")


class Struct(msgspec.Struct, frozen=True, forbid_unknown_fields=True, gc=False):
    """A part of a message: no extra fields, never changed after it was made.

    What is read is validated. What is made is not, for speed, unless the class has the metaclass `Checked`.
    """

    def plain(self) -> dict[str, Any]:
        """The fields as JSON has them: objects, lists, texts and numbers."""
        fields: dict[str, Any] = msgspec.to_builtins(self)
        return fields

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """The JSON Schema of the struct as it is written, whole."""
        return published(msgspec.json.schema(cls))

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """As a field of a model: taken as it is, or made of a mapping; written as its fields."""
        return core_schema.no_info_plain_validator_function(
            partial(_taken, cls),
            ref=f"{cls.__module__}.{cls.__name__}:{id(cls)}",
            serialization=core_schema.plain_serializer_function_ser_schema(msgspec.to_builtins),
        )

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """As a field of a model: in one piece, which `schemas.message.Part.json_schema` takes apart again."""
        return in_one_piece(cls.json_schema())


class StructMessage(Struct, frozen=True, kw_only=True):
    """A whole message; carries the version of the contract. See `schemas.message.WireMessage`."""

    max_bytes: ClassVar[int] = 65_536

    version: str = VERSION

    def encode(self) -> bytes:
        """The message as UTF-8 JSON; floats keep every bit."""
        return encode(self)

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        """The message in a payload.

        Raises:
            BadMessageError: too long, not JSON, not this message, or of another major version.
        """
        return decoded(cls, payload, _reader(cls), _fault)


class Checked(msgspec.StructMeta):
    """The metaclass of structs that people make in their brains: what is made by a call is checked as if it were read.

    What is read is checked by msgspec already, and costs nothing more. `msgspec.structs.replace` does not check.
    """

    def __call__(cls: type[T], *args: Any, **fields: Any) -> T:  # noqa: N805
        made: T = msgspec.StructMeta.__call__(cls, *args, **fields)
        check(cast(Struct, made))
        return made


def check(part: Struct) -> None:
    """Check what was made as what is read is checked; numbers of other libraries and words of enumerations are settled.

    Raises:
        FaultError: a field is of another type, beyond its limits, or no finite number.
    """
    for name in _odd_fields(part):
        _settle(part, name)


def _odd_fields(part: Struct) -> list[str]:
    """The fields whose values are not plainly what they may be."""
    numbers, others = _plan(part.__class__)
    odd = []
    for name, kind, low, high in numbers:
        value: Any = getattr(part, name)
        if value.__class__ is not kind or not low <= value <= high:
            odd.append(name)
    for name, looks in others:
        value = getattr(part, name)
        look = looks.get(value.__class__, _never)
        if look is not None and not look(value):
            odd.append(name)
    return odd


Look = Callable[[Any], object]
"""Whether a value of the right class is plainly what it may be."""


def _never(_: Any) -> bool:
    return False


class _Plan(NamedTuple):
    """What a check looks at."""

    numbers: list[tuple[str, type[Any], float, float]]
    """Field, class, least and greatest value."""
    others: list[tuple[str, dict[type, Look | None]]]
    """Field, and the classes that its value may be of, each with what has to be looked at besides."""


@cache
def _plan(kind: type[Struct]) -> _Plan:
    plan = _Plan([], [])
    for name in kind.__struct_fields__:
        base, limits = _split(hints_of(kind)[name])
        if base in (float, int, bool):
            plan.numbers.append((name, base, *_range(base, limits)))
        else:
            choices = get_args(base) if get_origin(base) in (Union, UnionType) else (base,)
            looks = [look for choice in choices for look in _looks(*_split(choice))]
            plan.others.append((name, dict(looks)))
    return plan


def _split(hint: Any) -> tuple[Any, list[Meta]]:
    """A type, and the limits that it is declared with."""
    if get_origin(hint) is not Annotated:
        return hint, []
    base, *limits = get_args(hint)
    return base, [one for one in limits if isinstance(one, Meta)]


def _looks(kind: Any, limits: list[Meta]) -> list[tuple[type, Look | None]]:
    """The class of a type, with what has to be looked at; none of a type whose values are looked at with care."""
    if isinstance(kind, Checked) or kind is NoneType or (isinstance(kind, type) and issubclass(kind, Enum)):
        return [(kind, None)]
    if isinstance(kind, type) and issubclass(kind, Struct):
        return [(kind, lambda part: not _odd_fields(part))]
    if kind is str:
        longest = min([one.max_length for one in limits if one.max_length is not None], default=sys.maxsize)
        patterns = [re.compile(one.pattern).search for one in limits if one.pattern is not None]
        return [(str, lambda text: len(text) <= longest and all(found(text) for found in patterns))]
    if get_origin(kind) is dict:
        return [(dict, lambda entries: not entries)]
    return []


def _range(kind: type, limits: list[Meta]) -> tuple[float, float]:
    """The least and the greatest value of a number."""
    if kind is bool:
        return False, True
    most = math.nextafter(math.inf, 0.0) if kind is float else math.inf
    lows = [one.ge for one in limits if one.ge is not None]
    lows += [math.nextafter(one.gt, math.inf) for one in limits if one.gt is not None]
    highs = [one.le for one in limits if one.le is not None]
    return max(lows, default=-most), min(highs, default=most)


def _settle(part: Struct, name: str) -> None:
    """Make a field's value one of its type, or say what is wrong with it."""
    value, hint = getattr(part, name), hints_of(part.__class__)[name]
    if getattr(value, "shape", None) == ():  # a scalar of numpy
        value = value.item()
    try:
        settled = msgspec.convert(value, hint)
        is_sound = _is_finite(settled)
    except (msgspec.ValidationError, FaultError):
        is_sound = False
    if not is_sound:
        fault = fault_in(hint, value) or Fault((), value, "cannot be read")
        raise FaultError(fault.below((name,)), _snake_case(part.__class__.__name__))
    if settled is not getattr(part, name):
        msgspec.structs.force_setattr(part, name, settled)


def _is_finite(value: Any) -> bool:
    """Whether all numbers in a value are; of a struct in it every limit is looked at."""
    if isinstance(value, Struct):
        check(value)
    if isinstance(value, dict):
        return all(_is_finite(item) for item in value.values())
    return not isinstance(value, float) or math.isfinite(value)


def _snake_case(name: str) -> str:
    return "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in name).lstrip("_")


@cache
def _reader(kind: type[StructMessage]) -> Any:
    return msgspec.json.Decoder(kind).decode


def _fault(kind: type[Any], payload: bytes, error: Exception) -> Fault:
    """What is wrong with a payload that msgspec has refused."""
    try:
        content = from_json(payload)
    except ValueError as reason:
        return not_json(payload, reason)
    return fault_in(kind, content) or Fault((), None, f"not to be read: {error}", FaultKind.RULE)


def _taken(kind: type[Struct], value: Any) -> Struct:
    """The struct that a model gets as a field's value."""
    part = value if isinstance(value, kind) else validated(kind, value)
    check(part)
    return part
