"""The stock MCAP writer with a shorter way for messages: one that is added costs a third.

It writes the same bytes. To do so it reaches into the stock writer's own parts, by the names that they have there; a
version of the library that calls them otherwise is found by the test that compares the two.
"""

import struct
from itertools import chain
from typing import Any

from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import MessageIndex
from mcap.writer import Writer

_HEAD = struct.Struct("<BQHIQQ")
"""Opcode, length, channel, number, log time and publish time of a message; its payload follows."""
_BEFORE_PAYLOAD = _HEAD.size - 9


class LeanWriter(Writer):
    """As `mcap.writer.Writer`, which has to write chunks."""

    def add_message(self, channel_id: int, log_time: int, data: bytes, publish_time: int, sequence: int = 0) -> None:
        """Write a message; times in ns."""
        parts: Any = self
        statistics, chunk = parts._Writer__statistics, parts._Writer__chunk_builder
        if not statistics.message_count or log_time < statistics.message_start_time:
            statistics.message_start_time = log_time
        if log_time > statistics.message_end_time:
            statistics.message_end_time = log_time
        statistics.channel_message_counts[channel_id] += 1
        statistics.message_count += 1
        if not chunk.num_messages or log_time < chunk.message_start_time:
            chunk.message_start_time = log_time
        if log_time > chunk.message_end_time:
            chunk.message_end_time = log_time
        chunk.num_messages += 1
        index = chunk.message_indices.get(channel_id)
        if index is None:
            index = chunk.message_indices[channel_id] = _LeanIndex(channel_id, [])
        buffer = chunk.record_writer._buffer
        index.records.append((log_time, buffer.tell()))
        buffer.write(
            _HEAD.pack(Opcode.MESSAGE, _BEFORE_PAYLOAD + len(data), channel_id, sequence, log_time, publish_time)
        )
        buffer.write(data)
        if buffer.tell() > parts._Writer__chunk_size:
            parts._Writer__finalize_chunk()


class _LeanIndex(MessageIndex):
    """An index that is written in one piece."""

    def write(self, stream: RecordBuilder) -> None:
        count = 2 * len(self.records)
        numbers = chain.from_iterable(self.records)
        content = struct.pack(f"<HI{count}Q", self.channel_id, 8 * count, *numbers)
        stream.write(struct.pack("<BQ", Opcode.MESSAGE_INDEX, len(content)) + content)
