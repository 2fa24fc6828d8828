"""Messages and parts that are written and read in every tick: msgspec structs, whose annotations hold their limits.

A robot's process is woken for each sight after nine others have used the CPU's caches, so its cost is the memory that
it touches, and a struct keeps nothing but its fields. A struct can be a field of a pydantic model, where it is
validated, written and described in the same way.
"""

import math
import re
import sys
from collections.abc import Callable, Iterable
from enum import Enum
from functools import cache, partial
from types import NoneType, UnionType
from typing import Annotated, Any, ClassVar, NamedTuple, Self, TypeVar, Union, cast, get_args, get_origin

import msgspec
from msgspec import Meta
from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema, from_json

from schemas.wire.faults import Fault, FaultError, FaultKind, hints_of, not_json
from schemas.wire.field_docstrings import field_docstrings
from schemas.wire.json_schema import in_one_piece, published
from schemas.wire.message import VERSION, decode_payload
from schemas.wire.struct_faults import fault_in, validated

encode = msgspec.json.Encoder(enc_hook=dict).encode
"""Structs, models, dataclasses and mappings of them as UTF-8 JSON; floats keep every bit, and NaN is null."""

T = TypeVar("T")


class Struct(msgspec.Struct, frozen=True, forbid_unknown_fields=True, gc=False):
    """A part of a message: immutable, without unknown fields.

    Decoding validates. Construction does not, for speed, unless the class has the metaclass `Checked`.
    """

    def plain(self) -> dict[str, Any]:
        """The fields as JSON values: objects, lists, texts and numbers."""
        fields: dict[str, Any] = msgspec.to_builtins(self)
        return fields

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """The JSON Schema of the struct as it is written, with all definitions."""
        return published(msgspec.json.schema(cls), {part.__name__: field_docstrings(part) for part in _structs_in(cls)})

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """As a field of a model: an instance as it is, or made from a mapping; serialized as its fields."""
        return core_schema.no_info_plain_validator_function(
            partial(_as_struct, cls),
            ref=f"{cls.__module__}.{cls.__name__}:{id(cls)}",
            serialization=core_schema.plain_serializer_function_ser_schema(msgspec.to_builtins),
        )

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """As a field of a model: in one piece, which `schemas.wire.message.Part.json_schema` separates again."""
        return in_one_piece(cls.json_schema())


class StructMessage(Struct, frozen=True, kw_only=True):
    """A whole message, with the version of the protocol. See `schemas.wire.message.WireMessage`."""

    max_bytes: ClassVar[int] = 65_536

    version: str = VERSION
    """Version of the protocol that the sender implements, "major.minor"."""

    def encode(self) -> bytes:
        """The message as UTF-8 JSON; floats keep every bit."""
        return encode(self)

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        """The message in a payload.

        Raises:
            BadMessageError: too long, not JSON, not this message, or of another major version.
        """
        return decode_payload(cls, payload, _decoder(cls), _fault)


class Checked(msgspec.StructMeta):
    """The metaclass of structs that brains construct: a constructor call is checked like a decoded struct.

    Decoding and `msgspec.structs.replace` do not call it, so that nothing is checked twice.
    """

    def __call__(cls: type[T], *args: Any, **fields: Any) -> T:  # noqa: N805
        part: T = msgspec.StructMeta.__call__(cls, *args, **fields)
        struct = cast(Struct, part)
        _check_fields(struct, (*struct.__struct_fields__[: len(args)], *fields) if args else fields)
        return part


def check(part: Struct) -> None:
    """Check a constructed struct as a decoded one is checked.

    Converts scalars of numpy to Python's numbers, and values of enumerations to their members.

    Raises:
        FaultError: a field has another type, is beyond its limits, or is not a finite number.
    """
    _check_fields(part, part.__struct_fields__)


def _check_fields(part: Struct, names: Iterable[str]) -> None:
    """Check these fields, as those that a constructor was given: the defaults of the others are valid."""
    for name in _suspect_fields(part, names):
        _convert(part, name)


def _suspect_fields(part: Struct, names: Iterable[str]) -> list[str]:
    """Those of these fields whose values a quick check does not accept."""
    numbers, others = _plan(part.__class__)
    suspect = []
    for name in names:
        value: Any = getattr(part, name)
        number = numbers.get(name)
        if number is not None:
            kind, low, high = number
            if value.__class__ is not kind or not low <= value <= high:
                suspect.append(name)
        elif (test := others[name].get(value.__class__, _never)) is not None and not test(value):
            suspect.append(name)
    return suspect


Test = Callable[[Any], object]
"""Whether a value of the right class passes the quick check."""


def _never(_: Any) -> bool:
    return False


class _Plan(NamedTuple):
    """The quick check of one class."""

    numbers: dict[str, tuple[type[Any], float, float]]
    """Field → class, least and greatest value."""
    others: dict[str, dict[type, Test | None]]
    """Field → the classes that its value may have, each with a further test or None."""


@cache
def _plan(kind: type[Struct]) -> _Plan:
    plan = _Plan({}, {})
    for name in kind.__struct_fields__:
        base, limits = _split(hints_of(kind)[name])
        if base in (float, int, bool):
            plan.numbers[name] = base, *_range(base, limits)
        else:
            choices = get_args(base) if get_origin(base) in (Union, UnionType) else (hints_of(kind)[name],)
            tests = [test for choice in choices for test in _tests(*_split(choice))]
            plan.others[name] = dict(tests)
    return plan


def _split(hint: Any) -> tuple[Any, list[Meta]]:
    """A type and its declared limits."""
    if get_origin(hint) is not Annotated:
        return hint, []
    base, *limits = get_args(hint)
    return base, [one for one in limits if isinstance(one, Meta)]


def _tests(kind: Any, limits: list[Meta]) -> list[tuple[type, Test | None]]:
    """The class of a type with its further test; empty for a type whose values always need the full check."""
    if isinstance(kind, Checked) or kind is NoneType or (isinstance(kind, type) and issubclass(kind, Enum)):
        return [(kind, None)]
    if isinstance(kind, type) and issubclass(kind, Struct):
        return [(kind, lambda part: not _suspect_fields(part, part.__struct_fields__))]
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


def _convert(part: Struct, name: str) -> None:
    """Convert the value of a field to its type.

    Raises:
        FaultError: the value is not valid.
    """
    value, hint = getattr(part, name), hints_of(part.__class__)[name]
    if getattr(value, "shape", None) == ():  # a scalar of numpy
        value = value.item()
    try:
        converted = msgspec.convert(value, hint)
        is_valid = _is_finite(converted)
    except (msgspec.ValidationError, FaultError):
        is_valid = False
    if not is_valid:
        fault = fault_in(hint, value) or Fault((), value, "cannot be read")
        raise FaultError(fault.below((name,)), _snake_case(part.__class__.__name__))
    if converted is not getattr(part, name):
        msgspec.structs.force_setattr(part, name, converted)


def _is_finite(value: Any) -> bool:
    """Whether all numbers in a value are finite; a struct in it is checked against all its limits."""
    if isinstance(value, Struct):
        check(value)
    if isinstance(value, dict):
        return all(_is_finite(item) for item in value.values())
    return not isinstance(value, float) or math.isfinite(value)


def _structs_in(hint: Any) -> set[type[Struct]]:
    """The structs in a type, with those in their fields."""
    if isinstance(hint, type) and issubclass(hint, Struct):
        return {hint}.union(*[_structs_in(inner) for inner in hints_of(hint).values()])
    return {struct for inner in get_args(hint) for struct in _structs_in(inner)}


def _snake_case(name: str) -> str:
    return "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in name).lstrip("_")


@cache
def _decoder(kind: type[StructMessage]) -> Any:
    return msgspec.json.Decoder(kind).decode


def _fault(kind: type[Any], payload: bytes, error: Exception) -> Fault:
    """The fault of a payload that msgspec has refused."""
    try:
        content = from_json(payload)
    except ValueError as reason:
        return not_json(payload, reason)
    return fault_in(kind, content) or Fault((), None, f"cannot be read: {error}", FaultKind.RULE)


def _as_struct(kind: type[Struct], value: Any) -> Struct:
    """The value of a model's field as a struct."""
    part = value if isinstance(value, kind) else validated(kind, value)
    check(part)
    return part
