"""The type of a message as a `.proto` file, for protobuf compilers."""

from google.protobuf.descriptor import Descriptor, FieldDescriptor

_TYPE_NAMES = {
    FieldDescriptor.TYPE_DOUBLE: "double",
    FieldDescriptor.TYPE_INT64: "int64",
    FieldDescriptor.TYPE_BOOL: "bool",
    FieldDescriptor.TYPE_STRING: "string",
}


def proto_text(message: Descriptor) -> str:
    """The `.proto` file of a message, with its nested messages."""
    head = ['syntax = "proto3";', f"package {message.file.package};"]
    head += [f'import "{imported.name}";' for imported in message.file.dependencies]
    return "\n".join([*head, "", *_lines(message, "")]) + "\n"


def _lines(message: Descriptor, indent: str) -> list[str]:
    inner = indent + "  "
    lines = [f"{indent}message {message.name} {{"]
    for nested in message.nested_types:
        if not nested.GetOptions().map_entry:
            lines += _lines(nested, inner)
    lines += [f"{inner}{_type(field)} {field.name} = {field.number};" for field in message.fields]
    return [*lines, f"{indent}}}"]


def _type(field: FieldDescriptor) -> str:
    if field.message_type is not None and field.message_type.GetOptions().map_entry:
        return f"map<string, {_type_name(field.message_type.fields_by_name['value'])}>"
    if field.is_repeated:
        return f"repeated {_type_name(field)}"
    return f"optional {_type_name(field)}" if field.message_type is None and field.has_presence else _type_name(field)


def _type_name(field: FieldDescriptor) -> str:
    message = field.message_type
    if message is None:
        return _TYPE_NAMES[field.type]
    return message.name if message.containing_type is not None else message.full_name
