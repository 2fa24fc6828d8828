"""The file of a message as a `.proto`, for the compiler of any language."""

from google.protobuf.descriptor import Descriptor, FieldDescriptor

_WORDS = {
    FieldDescriptor.TYPE_DOUBLE: "double",
    FieldDescriptor.TYPE_INT64: "int64",
    FieldDescriptor.TYPE_BOOL: "bool",
    FieldDescriptor.TYPE_STRING: "string",
}


def proto_text(message: Descriptor) -> str:
    """The only message of a file, with those that are nested in it."""
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
        return f"map<string, {_word(field.message_type.fields_by_name['value'])}>"
    if field.is_repeated:
        return f"repeated {_word(field)}"
    return f"optional {_word(field)}" if field.message_type is None and field.has_presence else _word(field)


def _word(field: FieldDescriptor) -> str:
    message = field.message_type
    if message is None:
        return _WORDS[field.type]
    return message.name if message.containing_type is not None else message.full_name
