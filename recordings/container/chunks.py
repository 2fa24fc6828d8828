"""Reads chunks of an MCAP file with their checksums, and iterates over their records without decoding them."""

import struct
from collections.abc import Iterator
from dataclasses import replace
from typing import IO

import zstandard
from lz4 import frame as lz4
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Chunk
from mcap.stream_reader import get_chunk_data_stream

BROKEN = (
    McapError, ValueError, LookupError, OverflowError, MemoryError, RuntimeError, struct.error, zstandard.ZstdError,
)  # fmt: skip
"""Exceptions that reading truncated or damaged bytes raises."""
RECORD_HEADER = struct.Struct("<BQ")
"""Header of a record: opcode, and length of the content."""
_LAST_OPCODE = max(Opcode)
_MOST_BYTES, _MOST_RATIO = 32 * 2**20, 4
"""Most bytes of an unpacked chunk, and how many more for each packed one: some kB may claim to be GB. Chosen here:
writers end a chunk at some MB, or with a larger message, such as an image or a point cloud, which packs no better."""
PRIVATE = 0x80
"""Readers ignore records with this opcode or a higher one."""
MESSAGE = struct.Struct("<HIQQ")
"""Beginning of a message's content: channel, sequence, log time and publish time in ns. The payload follows."""


def is_known(opcode: int) -> bool:
    """Whether a record with this opcode is one of MCAP, or private."""
    return 0 < opcode <= _LAST_OPCODE or opcode >= PRIVATE


def read_chunk(file: IO[bytes], at: int) -> bytes:
    """Return the uncompressed records of the chunk whose header begins at offset `at` of a file.

    Raises:
        BROKEN: the chunk is damaged.
    """
    try:
        file.seek(at + RECORD_HEADER.size)
    except OSError:
        raise ValueError(f"no file has the offset {at}") from None
    stream, size = get_chunk_data_stream(unpacked(Chunk.read(ReadDataStream(file))), validate_crc=True)
    return stream.read(size)


def unpacked(chunk: Chunk) -> Chunk:
    """The chunk without compression.

    Raises:
        BROKEN: its content is damaged, or has more bytes than such a chunk may have.
    """
    claimed, data = chunk.uncompressed_size, chunk.data
    most = _MOST_BYTES + _MOST_RATIO * len(data)
    if chunk.compression == "zstd":
        claimed = max(claimed, zstandard.frame_content_size(data))  # the frame's own size decides what is unpacked
        data = zstandard.decompress(data, claimed) if claimed <= most else b""
    elif chunk.compression == "lz4":
        data = lz4.LZ4FrameDecompressor().decompress(data, max_length=most + 1)
    if max(claimed, len(data)) > most:
        raise ValueError(f"a chunk of {len(chunk.data)} bytes unpacks to more than {most >> 20} MiB")
    return replace(chunk, compression="", data=data)


def records_in(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Yield opcode, begin of the content and end of the content of each record in a chunk.

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
