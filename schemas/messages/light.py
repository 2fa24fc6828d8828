"""Light readers: a message as plain structs, for whoever reads the same kind fifty times a second, or says it again.

A robot's process is woken for each sight, when nine others have been at the caches since: what it touches is what it
costs. A model of pydantic keeps two dictionaries and a set for each of its parts; a struct of msgspec keeps its fields
and nothing else. So the struct is derived from the model, with the same fields, limits and defaults, and the model
remains what the message means: it reads whatever the struct refuses, and says why where it refuses it too.
"""

import dataclasses
import re
import types
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from typing import Annotated, Any, TypeVar, Union, cast, get_args, get_origin, get_type_hints

import msgspec
from annotated_types import Ge, Gt, Le, Lt, MaxLen, MinLen
from pydantic import StringConstraints
from pydantic.fields import FieldInfo
from pydantic_core import to_json

from schemas.message import VERSION, Message, Part

M = TypeVar("M", bound=Message)
K = TypeVar("K")

light_encode = msgspec.json.Encoder(enc_hook=vars).encode
"""What structs, models, dataclasses and mappings hold, as JSON: to the byte what pydantic writes of numbers below 1e16;
beyond, their exponent has no sign."""
_MAYBE_HUGE = re.compile(rb"e\d")
"""Stands in the JSON of every number from 1e16 on, and now and then in that of a word."""

_LIMITS: Mapping[type, Callable[[Any], dict[str, Any]]] = {
    Ge: lambda limit: {"ge": limit.ge},
    Gt: lambda limit: {"gt": limit.gt},
    Le: lambda limit: {"le": limit.le},
    Lt: lambda limit: {"lt": limit.lt},
    MinLen: lambda limit: {"min_length": limit.min_length},
    MaxLen: lambda limit: {"max_length": limit.max_length},
    StringConstraints: lambda limit: _text(limit),
}
"""How a limit of a model is said to a struct."""


def light_encode_exactly(thing: Any) -> bytes:
    """As `light_encode`, and to the byte what pydantic writes of all other numbers too."""
    text = light_encode(thing)
    return text if _MAYBE_HUGE.search(text) is None else to_json(thing, fallback=dict)


def beyond_defaults(part: Part) -> dict[str, Any]:
    """The fields of a part, light or not, that are not what they are by default; likewise of the parts in it."""
    said = {}
    for name, default in _defaults(part.__class__):
        value = getattr(part, name)
        if value != default:
            said[name] = beyond_defaults(value) if _is_part(value.__class__) else value
    return said


def light_reader(model: type[M]) -> Callable[[bytes], M]:
    """What reads payloads of one kind of message.

    It answers with an object that has the fields of the model and never changes, but is no instance of it. `dict` of it
    is what it is of the model, and it can stand in a message wherever such a part may. The reader raises
    `BadMessageError` as `Message.decode` does, and for the same payloads.

    Raises:
        TypeError: a field of the model has a limit that structs do not know, or a type that they read otherwise.
    """
    decode = msgspec.json.Decoder(_struct(model), dec_hook=_as_itself).decode

    def read(payload: bytes) -> M:
        if len(payload) <= model.max_bytes:
            try:
                message = decode(payload)
            except (ValueError, RecursionError):
                return model.decode(payload)
            if message.version == VERSION:
                return cast(M, message)
        return model.decode(payload)

    return read


def light_form(kind: type[K]) -> type[K]:
    """What makes messages, parts or dataclasses of one kind as structs, of parts that are models or structs themselves.

    It looks at none of its values: it is for who has looked at them, or made them of such as were looked at.
    """
    return cast(type[K], _struct(kind) if issubclass(kind, Part) else _struct_of_fields(kind))


class _Light(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, gc=False):
    """What was read, or made."""

    def encode(self) -> bytes:
        """As `Message.encode`."""
        return light_encode(self)

    def __iter__(self) -> Iterator[tuple[str, Any]]:
        """Field and value, as models have it: `dict(part)` are the fields."""
        return ((name, getattr(self, name)) for name in self.__struct_fields__)


@cache
def _struct(model: type[Part]) -> Any:
    """The struct of a model whose meaning is all in its fields; any other stays what it is."""
    if not _is_plain(model):
        return model
    hints = get_type_hints(model, include_extras=True)
    fields = [(name, _type(hints[name]), *_default(info)) for name, info in model.model_fields.items()]
    return msgspec.defstruct(model.__name__, fields, bases=(_Light,), module=__name__, kw_only=True)


def _struct_of_fields(kind: type[Any]) -> Any:
    """The struct of a dataclass whose defaults never change."""
    fields = [
        (one.name, Any) if one.default is dataclasses.MISSING else (one.name, Any, one.default)
        for one in dataclasses.fields(kind)
    ]
    return msgspec.defstruct(kind.__name__, fields, bases=(_Light,), module=__name__)


def _is_plain(model: type[Part]) -> bool:
    """Whether a model has no rule and no method of its own."""
    own = [getattr(model, name) for name in set(dir(model)) - set(dir(Message))]
    return not any(callable(thing) or isinstance(thing, property) for thing in own)


def _default(info: FieldInfo) -> tuple[Any, ...]:
    if info.is_required():
        return ()
    if info.default_factory is not None:
        return (msgspec.field(default_factory=cast(Callable[[], Any], info.default_factory)),)
    default = info.default
    return (_as_light(default) if isinstance(default, Part) and _is_plain(type(default)) else default,)


def _type(hint: Any) -> Any:
    """A type of a model's field as a struct has it."""
    inner = get_args(hint)
    match get_origin(hint):
        case None:
            if dataclasses.is_dataclass(hint):
                raise TypeError(f"{hint!r} would be read with fields that nobody knows")
            return _struct(hint) if isinstance(hint, type) and issubclass(hint, Part) else hint
        case origin if origin is Annotated:
            return Annotated[_type(inner[0]), msgspec.Meta(**_limits(inner[1:]))]
        case origin if origin in (Union, types.UnionType):
            return Union[tuple(_type(choice) for choice in inner)]  # noqa: UP007
        case origin:
            return origin[tuple(_type(item) for item in inner)]


def _limits(metadata: Iterable[Any]) -> dict[str, Any]:
    """The limits that a field is declared with."""
    said: dict[str, Any] = {}
    for limit in (inner for one in metadata for inner in (one.metadata if isinstance(one, FieldInfo) else [one])):
        if type(limit) not in _LIMITS:
            raise TypeError(f"{limit!r} is no limit that a struct knows")
        said |= _LIMITS[type(limit)](limit)
    return said


def _text(limit: StringConstraints) -> dict[str, Any]:
    """Python's `$` also stands before a last line break, where pydantic's ends the text."""
    known = {"pattern": limit.pattern, "min_length": limit.min_length, "max_length": limit.max_length}
    if isinstance(limit.pattern, str) and limit.pattern.endswith("$"):
        known["pattern"] = rf"{limit.pattern[:-1]}\Z"
    return {key: value for key, value in known.items() if value is not None}


@cache
def _is_part(kind: type) -> bool:
    return issubclass(kind, (Part, _Light))


@cache
def _defaults(kind: type[Any]) -> list[tuple[str, Any]]:
    """The fields of a model or a struct, each with what it is by default, or with something that nothing is."""
    if issubclass(kind, Part):
        return [(name, info.get_default(call_default_factory=True)) for name, info in kind.model_fields.items()]
    return [
        (one.name, one.default if one.default_factory is msgspec.NODEFAULT else one.default_factory())
        for one in msgspec.structs.fields(kind)
    ]


def _as_light(part: Part) -> Any:
    return msgspec.convert(part.model_dump(mode="json"), _struct(type(part)), dec_hook=_as_itself)


def _as_itself(model: type, content: Any) -> Any:
    """A part that stayed a model."""
    return cast(type[Part], model).model_validate(content)
