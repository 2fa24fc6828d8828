"""Finds records of a recording by their first bytes, where damage hides their place and no summary lists them."""

import mmap
import struct
from collections.abc import Iterator

from mcap.opcode import Opcode

from recordings.container.chunks import RECORD_HEADER
from recordings.container.manifest import MANIFEST, MANIFEST_COPY, RESULT

_CHUNK_PACKED = struct.Struct("<Q")
"""Size of the compressed content of a chunk, which stands before it."""


def record_places(content: mmap.mmap) -> list[int]:
    """Offsets at which a chunk, a manifest or a result begins and fits into the file, in order."""
    places = [*_chunk_places(content)]
    for name in (MANIFEST, MANIFEST_COPY, RESULT):
        places += _metadata_places(content, name)
    return sorted(places)


def _chunk_places(content: mmap.mmap) -> Iterator[int]:
    """A chunk has times, size and checksum before the name of its compression, and its own size behind it."""
    for name in (_text("zstd"), _text("lz4")):
        for found in _occurrences(content, name):
            at = found - 28 - RECORD_HEADER.size
            end = _record_end(content, at, Opcode.CHUNK)
            packed = found + len(name)
            if end is not None and packed + _CHUNK_PACKED.size <= end:
                (size,) = _CHUNK_PACKED.unpack_from(content, packed)
                if packed + _CHUNK_PACKED.size + size == end:
                    yield at


def _metadata_places(content: mmap.mmap, name: str) -> Iterator[int]:
    for found in _occurrences(content, _text(name)):
        at = found - RECORD_HEADER.size
        if _record_end(content, at, Opcode.METADATA) is not None:
            yield at


def _text(text: str) -> bytes:
    """A string in MCAP: its length, and its bytes."""
    return struct.pack("<I", len(text)) + text.encode()


def _occurrences(content: mmap.mmap, pattern: bytes) -> Iterator[int]:
    at = content.find(pattern)
    while at >= 0:
        yield at
        at = content.find(pattern, at + 1)


def _record_end(content: mmap.mmap, at: int, opcode: Opcode) -> int | None:
    """End of the record that begins at this offset; None if there is no such record, or not all of it."""
    if at < 0:
        return None
    there, length = RECORD_HEADER.unpack_from(content, at)
    end = at + RECORD_HEADER.size + int(length)
    return end if there == opcode and end <= len(content) else None
