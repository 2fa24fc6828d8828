"""The fields of a message or a part, in words: their types, limits, defaults and meanings.

Meanings are the docstrings in the source; a number of a profile or a rule book declares its own, with the unit.
"""

import dataclasses
import types
from collections.abc import Callable, Iterator, Sequence
from enum import Enum
from typing import Annotated, Any, NamedTuple, Union, get_args, get_origin, get_type_hints

import msgspec
from annotated_types import Ge, Gt, Le, MaxLen
from pydantic import BaseModel, StringConstraints
from pydantic.fields import FieldInfo

from schemas.config.quantity import Choice, Quantity
from schemas.config.sensors.table import Reading, Sensor
from schemas.wire.field_docstrings import field_docstrings
from schemas.wire.message import Name
from schemas.wire.part import encode
from schemas.wire.units import MAX

Link = Callable[[type], str]
"""Gives the name of a part or an enumeration in the text."""

_CHOICES: dict[Any, list[type]] = {Sensor: list(Sensor.kinds().values()), Reading: list(Reading.kinds().values())}
"""A base → the types of the table of sensors that stand in its place."""
_PLAIN = {str: "text", bool: "true or false", int: "whole number", float: "number"}


class Row(NamedTuple):
    """One field."""

    name: str
    type: str
    default: str
    """The default as JSON; empty where the field is required."""
    meaning: str


def is_part(kind: Any) -> bool:
    """Whether a type has fields of its own."""
    return isinstance(kind, type) and (issubclass(kind, BaseModel | msgspec.Struct) or dataclasses.is_dataclass(kind))


def rows(part: type, link: Link) -> list[Row]:
    """The fields of a part in order, without `version`."""
    hints = get_type_hints(part, include_extras=True)
    docstrings = field_docstrings(part)
    tag = part.__struct_config__.tag if issubclass(part, msgspec.Struct) else None
    return [Row("kind", f'"{tag}"', "", "Kind of the sensor.")] * (tag is not None) + [
        Row(name, type_text(hints[name], link), default, _meaning(docstrings.get(name, ""), hints[name]))
        for name, default in _defaults(part)
        if name != "version"
    ]


def parts_of(part: type) -> Iterator[type]:
    """The parts and enumerations in the types of the fields, in order."""
    hints = get_type_hints(part, include_extras=True)
    for name, _ in _defaults(part):
        yield from _named_types(hints[name])


def type_text(hint: Any, link: Link) -> str:
    """A type in words, with its declared limits."""
    if hint == Name:
        return "name"
    if hint in (Any, msgspec.Raw):
        return "any JSON"
    if isinstance(hint, type) and hint in _CHOICES:
        return " or ".join(link(choice) for choice in _CHOICES[hint])
    if isinstance(hint, type) and hint in _PLAIN:
        return _PLAIN[hint]
    inner = get_args(hint)
    match get_origin(hint):
        case origin if origin is Annotated:
            limits = _limits(inner[0], inner[1:])
            return type_text(inner[0], link) + (f" ({limits})" if limits else "")
        case origin if origin in (Union, types.UnionType):
            words = [type_text(choice, link) for choice in inner if choice is not type(None)]
            return " or ".join(words + (["null"] if type(None) in inner else []))
        case origin if origin is list:
            return f"list of {type_text(inner[0], link)}"
        case origin if origin is tuple:
            return f"list of {type_text(inner[0], link)}"
        case origin if origin is dict:
            return f"{type_text(inner[0], link)} → {type_text(inner[1], link)}"
        case _:
            return link(hint)


def _named_types(hint: Any) -> Iterator[type]:
    if is_part(hint) or (isinstance(hint, type) and issubclass(hint, Enum)):
        yield hint
    yield from _CHOICES.get(hint, ()) if isinstance(hint, type) else ()
    for inner in get_args(hint):
        yield from _named_types(inner)


def _defaults(part: type) -> Iterator[tuple[str, str]]:
    """Field → its default as JSON; empty where the field is required."""
    if issubclass(part, BaseModel):
        for name, info in part.model_fields.items():
            required = info.is_required()
            yield name, "" if required else encode(info.get_default(call_default_factory=True)).decode()
        return
    if issubclass(part, msgspec.Struct):
        for one in msgspec.structs.fields(part):
            default = one.default if one.default_factory is msgspec.NODEFAULT else one.default_factory()
            yield one.name, "" if one.required else encode(default).decode()
        return
    assert dataclasses.is_dataclass(part)
    for field in dataclasses.fields(part):
        yield field.name, "" if field.default is dataclasses.MISSING else encode(field.default).decode()


def _limits(kind: Any, metadata: Sequence[Any]) -> str:
    limits: list[str] = []
    for item in (inner for one in metadata for inner in (one.metadata if isinstance(one, FieldInfo) else [one])):
        match item:
            case Ge(ge=bound):
                limits.append(f"at least {bound:g}")
            case Gt(gt=bound):
                limits.append(f"above {bound:g}")
            case Le(le=bound):
                limits.append(f"at most {bound:g}")
            case msgspec.Meta():
                bounds = ("at least", item.ge), ("above", item.gt), ("at most", item.le)
                limits += [f"{word} {bound:g}" for word, bound in bounds if bound not in (None, MAX, -MAX)]
                if item.max_length is not None:
                    limits.append(f"at most {item.max_length} {'characters' if kind is str else 'of them'}")
            case MaxLen(max_length=bound):
                limits.append(f"at most {bound} of them")
            case StringConstraints(max_length=int() as bound):
                limits.append(f"at most {bound} characters")
            case _:
                continue
    return ", ".join(limits)


def _meaning(docstring: str, hint: Any) -> str:
    """The declared meaning of a number of a profile or a rule book, with its unit; otherwise the docstring."""
    declared = [item.description for item in get_args(hint)[1:] if isinstance(item, Quantity | Choice)]
    return declared[0] if declared else docstring
