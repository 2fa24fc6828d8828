"""The stock MCAP writer with a shorter way for messages, where one that is added costs a third, and a choice of level.

Of the same level it writes the same bytes. To do so it reaches into the stock writer's own parts, by the names that
they have there; a version of the library that calls them otherwise is found by the test that compares the two.
"""

import struct
import zlib
from itertools import chain
from typing import IO, Any

import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import Chunk, ChunkIndex, MessageIndex
from mcap.writer import CompressionType, IndexType, Writer

_HEAD = struct.Struct("<BQHIQQ")
"""Opcode, length, channel, number, log time and publish time of a message; its payload follows."""
_BEFORE_BODY = 9
_BEFORE_PAYLOAD = _HEAD.size - _BEFORE_BODY
CHUNK_BYTES = 256 * 1024
"""Uncompressed size of a chunk: as small as compresses well, and stays in the cache."""
LEVEL = 1
"""Of zstd. On the messages of a match it takes half the time of the stock writer's 3, and packs no worse."""


class LeanWriter(Writer):
    """As `mcap.writer.Writer`, with chunks of `chunk_size` bytes that zstd packs, all indexes and all checksums."""

    def __init__(self, file: IO[bytes], chunk_size: int, level: int = LEVEL) -> None:
        super().__init__(
            file,
            chunk_size=chunk_size,
            compression=CompressionType.ZSTD,
            index_types=IndexType.ALL,
            enable_data_crcs=True,
        )
        self._compressor = zstandard.ZstdCompressor(level=level)

    def add_message(self, channel_id: int, log_time: int, data: bytes, publish_time: int, sequence: int = 0) -> None:
        """Write a message; times in ns."""
        parts: Any = self
        chunk = parts._Writer__chunk_builder
        index = chunk.message_indices.get(channel_id)
        if index is None:
            index = chunk.message_indices[channel_id] = _LeanIndex(channel_id, [])
        buffer = chunk.record_writer._buffer
        begin, length = buffer.tell(), _BEFORE_PAYLOAD + len(data)
        index.records.append((log_time, begin))
        buffer.write(_HEAD.pack(Opcode.MESSAGE, length, channel_id, sequence, log_time, publish_time))
        buffer.write(data)
        if begin + _BEFORE_BODY + length > parts._Writer__chunk_size:
            self._Writer__finalize_chunk()

    def _Writer__finalize_chunk(self) -> None:  # noqa: N802 - the stock writer's own, by the name that it has there
        """Write the chunk that is open, and its indexes."""
        parts: Any = self
        chunk, stream, records = parts._Writer__chunk_builder, parts._Writer__stream, parts._Writer__record_builder
        if not chunk.message_indices:
            return
        first, last = self._count(chunk.message_indices)
        content = chunk.end()
        packed = self._compressor.compress(content)
        parts._Writer__flush()
        begin = stream.tell()
        Chunk(
            compression="zstd",
            data=packed,
            message_start_time=first,
            message_end_time=last,
            uncompressed_crc=zlib.crc32(content),
            uncompressed_size=len(content),
        ).write(records)
        length = records.count
        parts._Writer__flush()
        indexes, places = stream.tell(), {}
        for channel, index in chunk.message_indices.items():
            places[channel] = indexes + records.count
            index.write(records)
        parts._Writer__chunk_indices.append(
            ChunkIndex(
                message_start_time=first,
                message_end_time=last,
                chunk_start_offset=begin,
                chunk_length=length,
                message_index_offsets=places,
                message_index_length=records.count,
                compression="zstd",
                compressed_size=len(packed),
                uncompressed_size=len(content),
            )
        )
        parts._Writer__flush()
        chunk.reset()

    def _count(self, indexes: dict[int, MessageIndex]) -> tuple[int, int]:
        """Enter a chunk's messages into the statistics; returns the first and the last of their log times."""
        parts: Any = self
        statistics = parts._Writer__statistics
        first = min(min(index.records)[0] for index in indexes.values())
        last = max(max(index.records)[0] for index in indexes.values())
        known = statistics.message_count
        statistics.message_start_time = min(statistics.message_start_time, first) if known else first
        statistics.message_end_time = max(statistics.message_end_time, last)
        for channel, index in indexes.items():
            statistics.channel_message_counts[channel] += len(index.records)
            statistics.message_count += len(index.records)
        statistics.chunk_count += 1
        return first, last


class _LeanIndex(MessageIndex):
    """An index that is written in one piece."""

    def write(self, stream: RecordBuilder) -> None:
        count = 2 * len(self.records)
        numbers = chain.from_iterable(self.records)
        content = struct.pack(f"<HI{count}Q", self.channel_id, 8 * count, *numbers)
        stream.write(struct.pack("<BQ", Opcode.MESSAGE_INDEX, len(content)) + content)
