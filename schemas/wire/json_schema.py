"""JSON Schemas in one form: the message at the root, and its definitions beside it, for readers in any language."""

import dataclasses
from collections.abc import Iterator
from inspect import cleandoc
from typing import Any, get_args

import msgspec
from pydantic import BaseModel

from schemas.wire.faults import hints_of
from schemas.wire.field_docstrings import descriptions
from schemas.wire.units import MAX

Schema = dict[str, Any]

_DEFINITIONS = "#/$defs/"
"""Prefix of a reference to a definition."""


def json_schema(kind: type) -> Schema:
    """The schema of a part, with the docstrings of all fields as descriptions."""
    of_models: Schema = {}

    def model_schema(model: type[BaseModel]) -> Schema:
        schema = model.model_json_schema(mode="serialization")
        of_models.update(schema.pop("$defs", {}))
        of_models[model.__name__] = schema
        return {"$ref": _DEFINITIONS + model.__name__}

    schema = msgspec.json.schema(kind, schema_hook=model_schema)
    definitions = {name: _plain(one) for name, one in schema["$defs"].items()}
    for part in set(_parts_in(kind)):
        texts = descriptions(part)
        for name, field in definitions[part.__name__]["properties"].items():
            field |= {"description": texts[name]} if name in texts else {}
    definitions = {**of_models, **definitions}
    own: Schema = definitions.pop(schema["$ref"].removeprefix(_DEFINITIONS))
    return {**own, "$defs": definitions} if definitions else own


def _parts_in(hint: Any) -> Iterator[type]:
    """The structs and dataclasses in a type, with those in their fields."""
    if isinstance(hint, type) and (issubclass(hint, msgspec.Struct) or dataclasses.is_dataclass(hint)):
        yield hint
        inner: Any = hints_of(hint).values()
    else:
        inner = get_args(hint)
    for one in inner:
        yield from _parts_in(one)


def _is_no_limit(value: Any) -> bool:
    return isinstance(value, float) and abs(value) == MAX


def _plain(schema: Any) -> Any:
    """A schema of msgspec without what only Python knows."""
    if isinstance(schema, list):
        return [_plain(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    own = {key: _plain(value) for key, value in schema.items() if not _is_no_limit(value)}
    if isinstance(own.get("enum"), list):
        own["type"] = "string"
    if isinstance(own.get("pattern"), str):
        own["pattern"] = own["pattern"].replace(r"\Z", "$")
    if isinstance(own.get("description"), str):
        own["description"] = cleandoc(own["description"])
    return own
