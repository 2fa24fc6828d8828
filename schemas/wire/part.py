"""The base of every message and its parts: msgspec structs, whose annotations hold their limits.

A robot's process is woken for each sight after nine others have used the CPU's caches, so its cost is the memory that
it touches, and a struct keeps nothing but its fields.

A model of the configuration (`schemas.config.config_model`) can be a field of a part. Only this module knows how it is
written and read there.
"""

from functools import cache
from typing import Any, Self, dataclass_transform

import msgspec
from pydantic import BaseModel
from pydantic_core import from_json

from schemas.wire.json_schema import json_schema


def _model(kind: type[BaseModel], content: Any) -> BaseModel:
    return kind.model_validate(content)


encode = msgspec.json.Encoder(enc_hook=dict).encode
"""Parts, models, dataclasses and mappings of them as UTF-8 JSON; floats keep every bit, and NaN is null."""


@cache
def decoder(kind: Any) -> msgspec.json.Decoder[Any]:
    """The decoder of a type, with the models of the configuration in it."""
    return msgspec.json.Decoder(kind, dec_hook=_model)


def convert(content: Any, kind: Any) -> Any:
    """JSON values as a value of a type.

    Raises:
        msgspec.ValidationError: the content is invalid; `schemas.wire.part_faults` names the fault.
    """
    return msgspec.convert(content, kind, dec_hook=_model)


def json_object(payload: bytes | str) -> dict[str, Any]:
    """The fields of a payload, whatever they are; none if it is not a JSON object."""
    try:
        fields = from_json(payload)
    except ValueError:
        return {}
    return fields if isinstance(fields, dict) else {}


class PartType(msgspec.StructMeta):
    """The metaclass of parts: they are immutable, constructed by keywords, and decoded without unknown fields."""

    def __new__(
        cls, name: str, bases: tuple[type, ...], namespace: dict[str, Any], *, kw_only: bool = True, **options: Any
    ) -> Any:
        """`options` are those of `msgspec.Struct`."""
        options |= {"kw_only": kw_only, "frozen": True, "forbid_unknown_fields": True, "gc": False}
        return super().__new__(cls, name, bases, namespace, **options)


@dataclass_transform(frozen_default=True, kw_only_default=True, field_specifiers=(msgspec.field,))
class Part(msgspec.Struct, metaclass=PartType, frozen=True):
    """A part of a message: immutable, without unknown fields, NaN or infinity.

    Decoding validates. Construction does not, for speed, unless the class has the metaclass
    `schemas.wire.checked.Checked`.
    """

    def plain(self, *left_out: str) -> dict[str, Any]:
        """The fields, but those `left_out`, as JSON values: objects, lists, texts and numbers."""
        fields: dict[str, Any] = msgspec.to_builtins(self, enc_hook=dict)
        return {name: value for name, value in fields.items() if name not in left_out} if left_out else fields

    def json(self) -> str:
        """The part as JSON; floats keep every bit."""
        return encode(self).decode()

    def replace(self, /, **changes: Any) -> Self:
        """The same part with other values, which are not checked."""
        return msgspec.structs.replace(self, **changes)

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """The JSON Schema of the part as it is written, with all definitions."""
        return json_schema(cls)
