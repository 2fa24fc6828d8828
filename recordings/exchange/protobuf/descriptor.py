"""Shape → what a reader needs to read it: the `FileDescriptorSet` beside a channel, and the `.proto` for people.

Numbers are those of the fields in protobuf's own `descriptor.proto`.
"""

from recordings.exchange.protobuf.shape import Kind, Shape, ShapeField
from recordings.viz.protobuf_wire import content, whole

PACKAGE = "touchline"
_OPTIONAL, _REPEATED = 1, 3
_WORDS = {Kind.DOUBLE: "double", Kind.INT64: "int64", Kind.BOOL: "bool", Kind.STRING: "string"}


def descriptor_set(root: Shape) -> bytes:
    """A `FileDescriptorSet` of one file."""
    file = (
        content(1, f"{root.name}.proto")
        + content(2, PACKAGE)
        + content(4, _message(root, root))
        + content(12, "proto3")
    )
    return content(1, file)


def _message(shape: Shape, root: Shape) -> bytes:
    out = content(1, shape.name)
    oneofs = ["kind"] if shape.is_value else [f"_{field.name}" for field in shape.fields if field.optional]
    for field in shape.fields:
        out += content(2, _field(field, shape, root, oneofs))
    nested = [_message(below, root) for below in shape.nested]
    nested += [_entry(field, root) for field in shape.fields if field.is_map]
    return out + b"".join(content(3, one) for one in nested) + b"".join(content(8, content(1, name)) for name in oneofs)


def _field(field: ShapeField, owner: Shape, root: Shape, oneofs: list[str]) -> bytes:
    label = whole(4, _REPEATED if field.repeated else _OPTIONAL)
    out = content(1, field.name) + whole(3, field.number) + label
    if field.is_map:
        path = root.name if owner is root else f"{root.name}.{owner.name}"
        out += whole(5, Kind.MESSAGE) + content(6, f".{PACKAGE}.{path}.{_entry_name(field)}")
    else:
        out += _type(field, root)
    if owner.is_value:
        out += whole(9, 0)
    elif field.optional:
        out += whole(9, oneofs.index(f"_{field.name}")) + whole(17, 1)
    return out


def _type(field: ShapeField, root: Shape) -> bytes:
    named = content(6, f".{PACKAGE}.{root.name}.{field.message.name}") if field.message is not None else b""
    return whole(5, field.kind) + named


def _entry(field: ShapeField, root: Shape) -> bytes:
    """The message that a map's entries are on the wire."""
    key = content(1, "key") + whole(3, 1) + whole(4, _OPTIONAL) + whole(5, Kind.STRING)
    value = content(1, "value") + whole(3, 2) + whole(4, _OPTIONAL) + _type(field, root)
    is_map_entry = content(7, whole(7, 1))
    return content(1, _entry_name(field)) + content(2, key) + content(2, value) + is_map_entry


def _entry_name(field: ShapeField) -> str:
    """As protobuf's own compiler calls it."""
    return "".join(word.capitalize() for word in field.name.split("_")) + "Entry"


def proto_text(root: Shape) -> str:
    """The same as a `.proto` file, for any language's compiler."""
    return f'syntax = "proto3";\npackage {PACKAGE};\n\n' + "\n".join(_lines(root, "")) + "\n"


def _lines(shape: Shape, indent: str) -> list[str]:
    inner = indent + "  "
    lines = [f"{indent}message {shape.name} {{"]
    for below in shape.nested:
        lines += _lines(below, inner)
    fields = [f"{inner}{_said(field)} {field.name} = {field.number};" for field in shape.fields]
    if shape.is_value:
        fields = [f"{inner}oneof kind {{", *(f"  {line}" for line in fields), f"{inner}}}"]
    return [*lines, *fields, f"{indent}}}"]


def _said(field: ShapeField) -> str:
    kind = field.message.name if field.message is not None else _WORDS[field.kind]
    if field.is_map:
        return f"map<string, {kind}>"
    return f"repeated {kind}" if field.repeated else f"optional {kind}" if field.optional else kind
