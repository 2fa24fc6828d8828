"""JSON Schemas in one form for models and structs: a message at the root, and its definitions beside it."""

from collections.abc import Mapping
from inspect import cleandoc
from typing import Any

Schema = dict[str, Any]

_DEFINITIONS = "#/$defs/"
"""Where a schema refers to its definitions."""


def published(schema: Schema) -> Schema:
    """A schema that msgspec wrote, with the message itself at its root, for readers in any language."""
    definitions = {name: _plain(one) for name, one in schema["$defs"].items()}
    own: Schema = definitions.pop(schema["$ref"].removeprefix(_DEFINITIONS))
    return {**own, "$defs": definitions} if definitions else own


def in_one_piece(schema: Schema) -> Schema:
    """The same schema with definitions in the places where it refers to them."""
    definitions = schema.get("$defs", {})
    whole: Schema = _filled_in({key: value for key, value in schema.items() if key != "$defs"}, definitions)
    return whole


def with_definitions(schema: Schema) -> Schema:
    """The same schema with references to definitions in place of objects and enumerations that have a title."""
    definitions: Schema = {}
    own = _taken_out({key: value for key, value in schema.items() if key != "$defs"}, definitions)
    for name, one in schema.get("$defs", {}).items():
        definitions[name] = _taken_out(one, definitions)
    return {**own, "$defs": definitions} if definitions else own


def _plain(schema: Any) -> Any:
    if isinstance(schema, list):
        return [_plain(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    own = {key: _plain(value) for key, value in schema.items()}
    if isinstance(own.get("enum"), list):
        own["type"] = "string"
    if isinstance(own.get("pattern"), str):
        own["pattern"] = own["pattern"].replace(r"\Z", "$")
    if isinstance(own.get("description"), str):
        own["description"] = cleandoc(own["description"])
    return own


def _filled_in(schema: Any, definitions: Mapping[str, Any]) -> Any:
    if isinstance(schema, list):
        return [_filled_in(one, definitions) for one in schema]
    if not isinstance(schema, dict):
        return schema
    own = {key: value for key, value in schema.items() if key != "$ref"}
    if isinstance(schema.get("$ref"), str):
        own = {**definitions[schema["$ref"].removeprefix(_DEFINITIONS)], **own}
    return {key: _filled_in(value, definitions) for key, value in own.items()}


def _taken_out(schema: Schema, definitions: Schema) -> Schema:
    """A schema itself, whose parts go among the definitions."""
    return {key: _referred_to(value, definitions) for key, value in schema.items()}


def _referred_to(schema: Any, definitions: Schema) -> Any:
    if isinstance(schema, list):
        return [_referred_to(one, definitions) for one in schema]
    if not isinstance(schema, dict):
        return schema
    own = _taken_out(schema, definitions)
    is_named = isinstance(own.get("title"), str) and ("properties" in own or "enum" in own)
    if not is_named:
        return own
    beside = {"default": own.pop("default")} if "default" in own else {}
    same = definitions.setdefault(own["title"], own)
    return {"$ref": _DEFINITIONS + own["title"], **beside} if same == own else {**own, **beside}
