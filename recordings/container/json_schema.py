"""The JSON Schema of a message: in full for programs, flattened for the viewers that open recordings.

Foxglove and Lichtblick support a small subset of JSON Schema: every field has one plain `type`, every object has
`properties`, an array holds scalars or objects. They drop a topic whose schema uses more, so the schema beside a
channel keeps to this subset. The full schema, with limits and defaults, is attached to the file.
"""

from collections.abc import Iterable
from functools import cache
from typing import Any

from schemas.wire.message import Message

_KEPT = ("title", "description", "enum", "contentEncoding")
"""Keywords that a viewer may show for a field, besides its type."""

_BY_ROBOT = frozenset({"robots", "inputs"})
"""Fields that are mappings from robots, in all messages."""


@cache
def whole_schema(model: type[Message]) -> dict[str, Any]:
    """The full JSON Schema of a message as it is sent on the bus. Callers must not modify it.

    Generating the schemas of all messages takes as long as a dozen ticks, so a recorder does it once, before the first.
    """
    return model.json_schema()


def flat_schema(model: type[Message], robots: Iterable[str] = ()) -> dict[str, Any]:
    """The schema without `$ref`, `$defs` and unions; a field that may be None has the type of its other values.

    Mappings from robots have a property for each of `robots`, so that viewers can complete `robots.cyan1.x`; others are
    allowed, too.
    """
    schema = whole_schema(model)
    flat = _flat(schema, schema.get("$defs", {}))
    for name in _BY_ROBOT & flat["properties"].keys():
        mapping = flat["properties"][name]
        if "additionalProperties" in mapping:
            mapping["properties"] = dict.fromkeys(robots, mapping["additionalProperties"])
    return flat


def _flat(schema: dict[str, Any], definitions: dict[str, Any]) -> dict[str, Any]:
    schema = _one_type(schema, definitions)
    flat = {key: schema[key] for key in ("type", *_KEPT) if key in schema}
    if flat["type"] == "object":
        flat["properties"] = {name: _flat(field, definitions) for name, field in schema.get("properties", {}).items()}
        flat |= _entries(schema, definitions)
    elif flat["type"] == "array":
        flat["items"] = _flat(schema["items"], definitions)
    return flat


def _entries(schema: dict[str, Any], definitions: dict[str, Any]) -> dict[str, Any]:
    """The `additionalProperties` of a mapping with free keys, if all its values have one type."""
    patterns = list(schema.get("patternProperties", {}).values())
    value = patterns[0] if patterns else schema.get("additionalProperties")
    if not isinstance(value, dict) or len(_choices(value, definitions)) > 1:
        return {}
    return {"additionalProperties": _flat(value, definitions)}


def _one_type(schema: dict[str, Any], definitions: dict[str, Any]) -> dict[str, Any]:
    """The schema itself, or the one schema that its reference or union stands for."""
    choices = _choices(schema, definitions)
    if len({choice.get("type") for choice in choices}) != 1 or "type" not in choices[0]:
        raise ValueError(f"no viewer reads a field of several types: {schema}; give it one type, or one type and None")
    return {**choices[0], **{key: schema[key] for key in _KEPT if key in schema}}


def _choices(schema: dict[str, Any], definitions: dict[str, Any]) -> list[dict[str, Any]]:
    """The schemas of all values besides None."""
    if "$ref" in schema:
        return _choices(definitions[schema["$ref"].removeprefix("#/$defs/")], definitions)
    if "anyOf" in schema:
        return [choice for option in schema["anyOf"] for choice in _choices(option, definitions)]
    return [] if schema.get("type") == "null" else [schema]
