"""Plain values → bytes of a shape; what is nothing, or empty, or 0 where nobody could tell it apart, costs none."""

from typing import Any

from recordings.exchange.protobuf.shape import VALUE_FIELDS, Kind, Shape, ShapeField
from recordings.viz.protobuf_wire import BYTES, DOUBLE, VARINT, content, double, tag, varint, whole


def encode(shape: Shape, values: dict[str, Any]) -> bytes:
    """A message from its fields as JSON would have them."""
    return b"".join([_field(field, values[field.name]) for field in shape.fields if values.get(field.name) is not None])


def _field(field: ShapeField, value: Any) -> bytes:
    if field.is_map:
        entries = [content(1, key) + _one(field, 2, entry) for key, entry in value.items()]
        return b"".join([content(field.number, entry) for entry in entries])
    if not field.repeated:
        return _one(field, field.number, value) if field.optional or value or field.message is not None else b""
    if field.kind in _PACKED:
        packed = b"".join([_PACKED[field.kind](one) for one in value])
        return content(field.number, packed) if packed else b""
    return b"".join([_one(field, field.number, one) for one in value])


def _one(field: ShapeField, number: int, value: Any) -> bytes:
    if field.kind is Kind.DOUBLE:
        return tag(number, DOUBLE) + double(value)
    if field.kind is Kind.STRING:
        return content(number, value)
    if field.message is None:
        return tag(number, VARINT) + varint(value)
    data = _value(field.message, value) if field.message.is_value else encode(field.message, value)
    return tag(number, BYTES) + varint(len(data)) + data


def _value(shape: Shape, value: Any) -> bytes:
    """A `Value`: the field that fits is written, be it 0."""
    if isinstance(value, bool):
        return whole(VALUE_FIELDS["flag"], value)
    if isinstance(value, int):
        return whole(VALUE_FIELDS["integer"], value)
    if isinstance(value, float):
        return tag(VALUE_FIELDS["number"], DOUBLE) + double(value)
    if isinstance(value, str):
        return content(VALUE_FIELDS["text"], value)
    return content(VALUE_FIELDS["list"], b"".join([content(1, _value(shape, one)) for one in value]))


_PACKED = {Kind.DOUBLE: double, Kind.INT64: varint, Kind.BOOL: varint}
"""Kinds whose repeated fields stand in one piece, as proto3 has it."""
