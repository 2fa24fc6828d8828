"""Builds the protobuf (proto3) type of a message from its JSON Schema.

Fields are numbered in the order of the model; readers use the schema in their own file. A field that may be None is
`optional`, a mapping is a `map`, and what has several types, or is a mapping in a mapping, is a
`google.protobuf.Value`.
"""

from typing import Any

from google.protobuf import struct_pb2
from google.protobuf.descriptor import Descriptor
from google.protobuf.descriptor_pb2 import DescriptorProto, FieldDescriptorProto, FileDescriptorProto
from google.protobuf.descriptor_pool import DescriptorPool

from recordings.container.json_schema import whole_schema
from schemas.wire.message import Message

PACKAGE = "touchline"
_PLAIN = {
    "number": FieldDescriptorProto.TYPE_DOUBLE,
    "integer": FieldDescriptorProto.TYPE_INT64,
    "boolean": FieldDescriptorProto.TYPE_BOOL,
    "string": FieldDescriptorProto.TYPE_STRING,
}
_VALUE = struct_pb2.Value.DESCRIPTOR
_Schema = dict[str, Any]


def message_type(model: type[Message]) -> Descriptor:
    """The protobuf type of a message, with all nested types."""
    file = _FileBuilder(model).file
    pool = DescriptorPool()
    pool.AddSerializedFile(_VALUE.file.serialized_pb)
    pool.Add(file)
    return pool.FindMessageTypeByName(f"{PACKAGE}.{model.__name__}")


class _FileBuilder:
    """Builds the file of one message. All other messages are nested in it, so that names in files do not clash."""

    def __init__(self, model: type[Message]) -> None:
        schema = whole_schema(model)
        self._definitions: dict[str, _Schema] = schema.get("$defs", {})
        self._names: set[str] = set()
        self.file = FileDescriptorProto(name=f"{model.__name__}.proto", package=PACKAGE, syntax="proto3")
        self._root = self.file.message_type.add(name=model.__name__)
        self._fill(self._root, schema)

    def _fill(self, message: DescriptorProto, schema: _Schema) -> None:
        for number, (name, content) in enumerate(schema["properties"].items(), 1):
            field = message.field.add(name=name, number=number, label=FieldDescriptorProto.LABEL_OPTIONAL)
            self._describe(field, content, message)

    def _describe(self, field: FieldDescriptorProto, schema: _Schema, owner: DescriptorProto) -> None:
        choices = _choices(schema)
        only = self._resolved(choices[0]) if len(choices) == 1 else {}
        if only.get("type") == "array":
            field.label = FieldDescriptorProto.LABEL_REPEATED
            self._set_type(field, only["items"])
        elif only.get("type") == "object" and "properties" not in only:
            field.label = FieldDescriptorProto.LABEL_REPEATED
            field.type = FieldDescriptorProto.TYPE_MESSAGE
            field.type_name = self._map_entry(field.name, only, owner)
        else:
            self._set_type(field, schema)
            is_nullable = len(choices) < len(schema.get("anyOf", [schema]))
            if is_nullable and field.type != FieldDescriptorProto.TYPE_MESSAGE:  # a message has presence in any case
                field.proto3_optional = True
                field.oneof_index = len(owner.oneof_decl)
                owner.oneof_decl.add(name=f"_{field.name}")

    def _map_entry(self, name: str, schema: _Schema, owner: DescriptorProto) -> str:
        """Add the entry message of a map; returns its full name."""
        entry = owner.nested_type.add(name="".join(word.capitalize() for word in name.split("_")) + "Entry")
        entry.options.map_entry = True
        optional = FieldDescriptorProto.LABEL_OPTIONAL
        entry.field.add(name="key", number=1, label=optional, type=FieldDescriptorProto.TYPE_STRING)
        value = entry.field.add(name="value", number=2, label=optional)
        patterns = list(schema.get("patternProperties", {}).values())
        self._set_type(value, patterns[0] if patterns else schema["additionalProperties"])
        return f"{self._full_name(owner)}.{entry.name}"

    def _set_type(self, field: FieldDescriptorProto, schema: _Schema) -> None:
        choices = _choices(schema)
        only = self._resolved(choices[0])
        plain = _PLAIN.get(str(only.get("type")))
        if len(choices) > 1 or "anyOf" in only or (only.get("type") == "object" and "properties" not in only):
            field.type, field.type_name = FieldDescriptorProto.TYPE_MESSAGE, f".{_VALUE.full_name}"
            if not self.file.dependency:
                self.file.dependency.append(_VALUE.file.name)
        elif plain is not None:
            field.type = plain
        else:
            field.type, field.type_name = FieldDescriptorProto.TYPE_MESSAGE, self._nested(choices[0])

    def _nested(self, schema: _Schema) -> str:
        """Add the message that a reference stands for, once; returns its full name."""
        name = _name(schema["$ref"])
        if name not in self._names:
            self._names.add(name)
            self._fill(self._root.nested_type.add(name=name), self._resolved(schema))
        return f"{self._full_name(self._root)}.{name}"

    def _full_name(self, message: DescriptorProto) -> str:
        root = f".{PACKAGE}.{self._root.name}"
        return root if message is self._root else f"{root}.{message.name}"

    def _resolved(self, schema: _Schema) -> _Schema:
        reference = schema.get("$ref")
        return self._definitions[_name(reference)] if reference is not None else schema


def _choices(schema: _Schema) -> list[_Schema]:
    """The schemas of all values besides None."""
    return [choice for choice in schema.get("anyOf", [schema]) if choice.get("type") != "null"]


def _name(reference: str) -> str:
    return reference.removeprefix("#/$defs/")
