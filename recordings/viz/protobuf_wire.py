"""Protobuf's wire format, as much of it as is written: varints, doubles, 32 bits, and bytes with their length."""

import struct

VARINT, DOUBLE, BYTES, FIXED32 = 0, 1, 2, 5
"""Wire types."""
_64_BITS = (1 << 64) - 1
_ONE_BYTE = [bytes((number,)) for number in range(0x80)]
"""Most numbers are small."""
double = struct.Struct("<d").pack
fixed32 = struct.Struct("<I").pack


def varint(number: int) -> bytes:
    """A whole number, seven bits at a time; negative ones in two's complement of 64 bits."""
    if 0 <= number <= 0x7F:
        return _ONE_BYTE[number]
    number &= _64_BITS
    out = bytearray()
    while number > 0x7F:
        out.append(number & 0x7F | 0x80)
        number >>= 7
    out.append(number)
    return bytes(out)


def tag(number: int, wire_type: int) -> bytes:
    """What stands before a field."""
    return varint(number << 3 | wire_type)


def whole(number: int, value: int) -> bytes:
    """A field with a whole number."""
    return tag(number, VARINT) + varint(value)


def content(number: int, value: bytes | str) -> bytes:
    """A field with bytes, a text, or a message."""
    data = value.encode() if isinstance(value, str) else value
    return tag(number, BYTES) + varint(len(data)) + data
