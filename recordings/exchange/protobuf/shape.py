"""What a message looks like in protobuf (proto3), from its JSON Schema.

Fields are numbered in the order in which the model has them; a reader goes by the schema of its own file. A field that
may be nothing is `optional`; a mapping is a `map`; one of several plain types is a `Value`.
"""

from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any

from recordings.container.json_schema import whole_schema
from schemas.message import Message


class Kind(IntEnum):
    """The types that are used, by their numbers in `FieldDescriptorProto.Type`."""

    DOUBLE = 1
    INT64 = 3
    BOOL = 8
    STRING = 9
    MESSAGE = 11


@dataclass(frozen=True, slots=True)
class ShapeField:
    """One field."""

    name: str
    number: int
    kind: Kind
    message: "Shape | None" = None
    """Of a field whose kind is `MESSAGE`."""
    repeated: bool = False
    optional: bool = False
    """Nothing is told from 0."""
    is_map: bool = False
    """Keys are texts; kind and message are those of the values."""


@dataclass(slots=True)
class Shape:
    """One message."""

    name: str
    fields: list[ShapeField] = field(default_factory=list)
    nested: list["Shape"] = field(default_factory=list)
    """Every message that is used below this one; those of a root stand in it, so that no two roots share a name."""
    is_value: bool = False
    """It holds one of its fields."""


_PLAIN = {"number": Kind.DOUBLE, "integer": Kind.INT64, "boolean": Kind.BOOL, "string": Kind.STRING}
VALUE_FIELDS = {"number": 1, "integer": 2, "flag": 3, "text": 4, "list": 5}
"""Field → number in a `Value`."""


def shape_of(model: type[Message]) -> Shape:
    """The shape of a message with everything below it."""
    schema = whole_schema(model)
    return _Shaper(model.__name__, schema.get("$defs", {})).root(schema)


class _Shaper:
    """Makes the shapes of one root."""

    def __init__(self, name: str, definitions: dict[str, Any]) -> None:
        self._root = Shape(name)
        self._definitions = definitions
        self._made: dict[str, Shape] = {}

    def root(self, schema: dict[str, Any]) -> Shape:
        """The root itself."""
        self._fill(self._root, schema)
        return self._root

    def _fill(self, shape: Shape, schema: dict[str, Any]) -> None:
        for number, (name, content) in enumerate(schema["properties"].items(), 1):
            shape.fields.append(self._field(name, number, content))

    def _field(self, name: str, number: int, schema: dict[str, Any]) -> ShapeField:
        choices = [choice for choice in schema.get("anyOf", [schema]) if choice.get("type") != "null"]
        optional = len(choices) < len(schema.get("anyOf", [schema]))
        one = self._resolved(choices[0])
        if len(choices) == 1 and one.get("type") == "array":
            kind, message = self._type(one["items"])
            return ShapeField(name, number, kind, message, repeated=True)
        if len(choices) == 1 and one.get("type") == "object" and "properties" not in one:
            patterns = list(one.get("patternProperties", {}).values())
            kind, message = self._type(patterns[0] if patterns else one["additionalProperties"])
            return ShapeField(name, number, kind, message, repeated=True, is_map=True)
        kind, message = self._type(choices[0] if len(choices) == 1 else {"anyOf": choices})
        return ShapeField(name, number, kind, message, optional=optional and kind is not Kind.MESSAGE)

    def _type(self, schema: dict[str, Any]) -> tuple[Kind, Shape | None]:
        choices = [choice for choice in schema.get("anyOf", [schema]) if choice.get("type") != "null"]
        if len(choices) > 1:
            return Kind.MESSAGE, self._value()
        one = self._resolved(choices[0])
        kind = _PLAIN.get(str(one.get("type")))
        return (kind, None) if kind is not None else (Kind.MESSAGE, self._message(choices[0]))

    def _resolved(self, schema: dict[str, Any]) -> dict[str, Any]:
        reference = schema.get("$ref")
        resolved: dict[str, Any] = self._definitions[_name(reference)] if reference is not None else schema
        return resolved

    def _message(self, schema: dict[str, Any]) -> Shape:
        name = _name(schema["$ref"])
        if name not in self._made:
            shape = self._made[name] = Shape(name)
            self._fill(shape, self._resolved(schema))
            self._root.nested.append(shape)
        return self._made[name]

    def _value(self) -> Shape:
        """One of a number, a text, a truth, or a list of these."""
        if "Value" not in self._made:
            value = self._made["Value"] = Shape("Value", is_value=True)
            values = Shape("Values", [ShapeField("values", 1, Kind.MESSAGE, value, repeated=True)])
            kinds = {**dict(zip(VALUE_FIELDS, _PLAIN.values(), strict=False)), "list": Kind.MESSAGE}
            for name, number in VALUE_FIELDS.items():
                value.fields.append(ShapeField(name, number, kinds[name], values if name == "list" else None))
            self._root.nested += [value, values]
        return self._made["Value"]


def _name(reference: str) -> str:
    return reference.removeprefix("#/$defs/")
