"""The chunks of an MCAP file: read with their checksum, and their records found one after the other, none decoded."""

import struct
from collections.abc import Iterator
from typing import IO

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.records import Chunk
from mcap.stream_reader import get_chunk_data_stream

BROKEN = (McapError, ValueError, LookupError, OverflowError, MemoryError, struct.error, zstandard.ZstdError)
"""What is raised on bytes that are cut off or damaged."""
RECORD_HEADER = struct.Struct("<BQ")
"""Opcode, and length of the content, of a record."""
MESSAGE = struct.Struct("<HIQQ")
"""Channel, sequence, log time and publish time, in ns, at the beginning of a message's content; its payload follows."""


def read_chunk(file: IO[bytes], at: int) -> bytes:
    """The records in the chunk whose head is at this place of a file.

    Raises:
        BROKEN: it is damaged.
    """
    file.seek(at + RECORD_HEADER.size)
    stream, size = get_chunk_data_stream(Chunk.read(ReadDataStream(file)), validate_crc=True)
    return stream.read(size)


def records_in(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Opcode of each record in a chunk, where its content begins, and where that ends.

    Raises:
        ValueError: the chunk ends within a record.
    """
    at, size, unpack_from = 0, len(data), RECORD_HEADER.unpack_from
    while at + RECORD_HEADER.size <= size:
        opcode, length = unpack_from(data, at)
        begin, at = at + RECORD_HEADER.size, at + RECORD_HEADER.size + length
        if at > size:
            break
        yield opcode, begin, at
    if at != size:
        raise ValueError("a chunk ends within a record")
