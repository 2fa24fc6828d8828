"""The records of an MCAP file: located by their headers and checked by their checksums, but not decoded."""

import mmap
import struct
import zlib
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import NamedTuple

import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import Channel, MessageIndex, Schema
from mcap.writer import MCAP0_MAGIC

from recordings.container.chunks import BROKEN, MESSAGE, PRIVATE, RECORD_HEADER, is_known, records_in
from recordings.container.mcap_file import bytes_of, stream_of

DAMAGED = 0x100
"""Stands for the opcode of a record whose header is damaged; no record has it."""
_CHUNK = struct.Struct("<QQQII")
"""First and last log time, size and checksum of the uncompressed content, length of the compression's name."""
EXTENT = struct.Struct("<QQ")
"""First and last log time, at the beginning of a chunk's content."""
_ENTRY = struct.Struct("<QQ")
"""An entry of an index: log time of a message, and its offset in the chunk."""
_INDEX = struct.Struct("<HI")
"""Channel, and size of its entries in bytes."""
_IN_DATA = frozenset({Opcode.CHUNK, Opcode.MESSAGE_INDEX, Opcode.ATTACHMENT, Opcode.METADATA})
"""Records between header and end of the data section; all others are in chunks, or after the data section."""
_DATA_END_BYTES = 4


class RawRecord(NamedTuple):
    """One record by its offsets."""

    opcode: int
    at: int
    """Offset of its header."""
    end: int

    @property
    def content(self) -> int:
        """Offset of its content."""
        return self.at + RECORD_HEADER.size


class ChunkHeader(NamedTuple):
    """The fields before the compressed content of a chunk."""

    first_ns: int
    last_ns: int
    size: int
    checksum: int
    compression: str
    packed: int
    """Offset of the compressed content."""


@dataclass(slots=True)
class RawChunk:
    """A chunk and the indexes that follow it."""

    raw: RawRecord
    indexes: list[RawRecord] = field(default_factory=list)
    broken: bool = False
    """Whether the header of one of the indexes is damaged."""

    @property
    def end(self) -> int:
        """Offset of the end of its last index."""
        return self.indexes[-1].end if self.indexes else self.raw.end


def raw_records_of(content: mmap.mmap, known: list[int]) -> Iterator[RawRecord]:
    """Yield the records of the data section, up to its end or to the first incomplete record.

    `known` are offsets at which records begin, in order. After a record with a damaged header, reading continues at the
    next of them, and the bytes between are one damaged record. A record that is not allowed in the data section counts
    as damaged, too: a bit of its opcode has changed.
    """
    at, size = len(MCAP0_MAGIC), len(content)
    places = iter(known)
    place = next(places, None)
    while at + RECORD_HEADER.size <= size:
        while place is not None and place <= at:
            place = next(places, None)
        opcode, length = RECORD_HEADER.unpack_from(content, at)
        end = at + RECORD_HEADER.size + length
        sound = is_known(opcode)
        if place is not None and (not sound or end > place):
            opcode, end = DAMAGED, place
        elif not sound or end > size:
            return
        elif not _is_allowed(opcode, at, end):
            opcode = DAMAGED
        yield RawRecord(opcode, at, end)
        if opcode == Opcode.DATA_END:
            return
        at = end


def _is_allowed(opcode: int, at: int, end: int) -> bool:
    """Whether a record with this opcode is allowed at this offset."""
    if opcode == Opcode.HEADER:
        return at == len(MCAP0_MAGIC)
    if opcode == Opcode.DATA_END:
        return end - at == RECORD_HEADER.size + _DATA_END_BYTES
    return opcode in _IN_DATA or opcode >= PRIVATE


def raw_chunks_of(raw_records: list[RawRecord], known: list[int]) -> dict[int, RawChunk]:
    """Chunks with the indexes that follow them, by offset.

    A damaged record after a chunk counts as an index, unless another record is `known` to begin there or `known` is
    empty.
    """
    places = frozenset(known)
    chunks: dict[int, RawChunk] = {}
    last: RawChunk | None = None
    for raw in raw_records:
        if raw.opcode == Opcode.CHUNK:
            last = chunks[raw.at] = RawChunk(raw)
        elif raw.opcode == Opcode.MESSAGE_INDEX and last is not None:
            last.indexes.append(raw)
        elif raw.opcode == DAMAGED and last is not None and places and raw.at not in places:
            last.indexes.append(raw)
            last.broken = True
        else:
            last = None
    return chunks


def damaged_chunks(content: mmap.mmap, chunks: dict[int, RawChunk]) -> set[int]:
    """Offsets of the chunks with a wrong checksum, computed on all cores."""
    with ThreadPoolExecutor() as pool:
        whole = pool.map(lambda chunk: _is_whole(content, chunk.raw), chunks.values())
        return {at for at, fits in zip(chunks, whole, strict=True) if not fits}


def _is_whole(content: mmap.mmap, raw: RawRecord) -> bool:
    try:
        return unpacked(content, raw) is not None
    except BROKEN:
        return False


def chunk_header(content: mmap.mmap, raw: RawRecord) -> ChunkHeader:
    """The header of a chunk.

    Raises:
        ValueError: the lengths in the header contradict each other.
    """
    first, last, size, checksum, name = _CHUNK.unpack_from(content, raw.content)
    at = raw.content + _CHUNK.size + name
    if name > 16 or at + 8 > raw.end or at + 8 + struct.unpack_from("<Q", content, at)[0] != raw.end:
        raise ValueError("chunk of another length")
    return ChunkHeader(first, last, size, checksum, content[at - name : at].decode(), at + 8)


def unpacked(content: mmap.mmap, raw: RawRecord) -> bytes:
    """The uncompressed records of a chunk.

    Raises:
        ValueError, zstandard.ZstdError: the chunk is damaged, or its compression is not supported.
    """
    header = chunk_header(content, raw)
    packed = content[header.packed : raw.end]
    if header.compression == "zstd":
        data = zstandard.ZstdDecompressor().decompress(
            packed
        )  # takes the length from the compressed bytes, not from the header
    elif header.compression == "":
        data = packed
    else:
        raise ValueError(f"compression {header.compression}")
    if len(data) != header.size or (header.checksum and zlib.crc32(data) != header.checksum):
        raise ValueError("checksum")
    return data


class ChunkContent(NamedTuple):
    """Schemas, channels and message indexes of a chunk."""

    schemas: dict[int, Schema]
    channels: dict[int, Channel]
    indexes: dict[int, MessageIndex]
    """Channel → times and offsets of its messages, as in the indexes that follow a chunk."""

    @property
    def extent(self) -> tuple[int, int] | None:
        """Log times of the first and the last message; None without messages."""
        times = [log_ns for index in self.indexes.values() for log_ns, _ in index.records]
        return (min(times), max(times)) if times else None


def content_of(data: bytes) -> ChunkContent:
    """Schemas, channels and the offsets of all messages in the uncompressed records of a chunk.

    Raises:
        BROKEN: a record is damaged.
    """
    found = ChunkContent({}, {}, {})
    for opcode, begin, end in records_in(data):
        if opcode == Opcode.MESSAGE:
            channel, _, log_ns, _ = MESSAGE.unpack_from(data, begin)
            index = found.indexes.setdefault(channel, MessageIndex(channel, []))
            index.records.append((log_ns, begin - RECORD_HEADER.size))
        elif opcode == Opcode.SCHEMA:
            schema = Schema.read(stream_of(data[begin:end]))
            found.schemas[schema.id] = schema
        elif opcode == Opcode.CHANNEL:
            channel_record = Channel.read(stream_of(data[begin:end]))
            found.channels[channel_record.id] = channel_record
    return found


def index_counts(content: mmap.mmap, chunk: RawChunk) -> dict[int, tuple[int, int]]:
    """Channel → number of its messages and offset of its index, from the indexes that follow a chunk."""
    found = {}
    for raw in chunk.indexes:
        channel, length = _INDEX.unpack_from(content, raw.content)
        found[channel] = length // 16, raw.at
    return found


def index_extent(content: mmap.mmap, chunk: RawChunk) -> tuple[int, int] | None:
    """Log times of the first and the last message, from the indexes that follow a chunk; None if they are damaged."""
    times: list[int] = []
    for raw in chunk.indexes:
        begin = raw.content + _INDEX.size
        if (raw.end - begin) % _ENTRY.size:
            return None
        times += (log_ns for log_ns, _ in _ENTRY.iter_unpack(content[begin : raw.end]))
    return (min(times), max(times)) if times else None


def index_bytes(indexes: dict[int, MessageIndex], at: int) -> tuple[bytes, dict[int, int]]:
    """The indexes of a chunk as bytes to be written at offset `at`, and channel → offset of its index."""
    builder, places = RecordBuilder(), {}
    for channel, index in indexes.items():
        places[channel] = at + builder.count
        index.write(builder)
    return bytes_of(builder), places
