"""JSON Schemas in one form for models and structs: the message at the root, and its definitions next to it."""

from collections.abc import Mapping
from inspect import cleandoc
from typing import Any

Schema = dict[str, Any]

_DEFINITIONS = "#/$defs/"
"""Prefix of a reference to a definition."""


def published(schema: Schema, descriptions: Mapping[str, Mapping[str, str]]) -> Schema:
    """A schema that msgspec made, with the message itself at its root, for readers in any language.

    Args:
        descriptions: class name → field → its description.
    """
    definitions: Schema = {}
    for name, one in schema["$defs"].items():
        definitions[name] = _plain(one)
        for field, description in descriptions.get(name, {}).items():
            definitions[name]["properties"][field]["description"] = description
    own: Schema = definitions.pop(schema["$ref"].removeprefix(_DEFINITIONS))
    return {**own, "$defs": definitions} if definitions else own


def in_one_piece(schema: Schema) -> Schema:
    """The same schema with each reference replaced by its definition.

    Where a reference has keys beside it, the definition stands alone in `allOf`, so that the two do not mix.
    """
    definitions = schema.get("$defs", {})
    whole: Schema = _inlined({key: value for key, value in schema.items() if key != "$defs"}, definitions)
    return whole


def with_definitions(schema: Schema) -> Schema:
    """The same schema with a reference in place of each object and enumeration that has a title."""
    definitions: Schema = {}
    own = _with_references({key: value for key, value in schema.items() if key != "$defs"}, definitions)
    for name, one in schema.get("$defs", {}).items():
        definitions[name] = _with_references(one, definitions)
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


def _inlined(schema: Any, definitions: Mapping[str, Any]) -> Any:
    if isinstance(schema, list):
        return [_inlined(one, definitions) for one in schema]
    if not isinstance(schema, dict):
        return schema
    own = {key: _inlined(value, definitions) for key, value in schema.items() if key != "$ref"}
    if not isinstance(schema.get("$ref"), str):
        return own
    definition = _inlined(definitions[schema["$ref"].removeprefix(_DEFINITIONS)], definitions)
    return {"allOf": [definition], **own} if own else definition


def _with_references(schema: Schema, definitions: Schema) -> Schema:
    """A schema whose titled parts are moved to the definitions."""
    return {key: _referenced(value, definitions) for key, value in schema.items()}


def _referenced(schema: Any, definitions: Schema) -> Any:
    if isinstance(schema, list):
        return [_referenced(one, definitions) for one in schema]
    if not isinstance(schema, dict):
        return schema
    own = _with_references(schema, definitions)
    match own:
        case {"allOf": [dict(only)]}:
            return {**only, **{key: value for key, value in own.items() if key != "allOf"}}
        case {"title": str(title)} if "properties" in own or "enum" in own:
            beside = {"default": own.pop("default")} if "default" in own else {}
            same = definitions.setdefault(title, own)
            return {"$ref": _DEFINITIONS + title, **beside} if same == own else {**own, **beside}
    return own
