"""Builds the end of an MCAP file from the records found in it: summary, summary offsets and footer."""

import zlib
from collections.abc import Iterable, Mapping
from typing import Any

from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    AttachmentIndex,
    Channel,
    ChunkIndex,
    DataEnd,
    Footer,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
    SummaryOffset,
)
from mcap.writer import MCAP0_MAGIC

from recordings.container.mcap_file import bytes_of, is_derived
from recordings.container.raw_records import ChunkHeader, RawRecord


class SummaryBuilder:
    """Collects the content of a summary."""

    def __init__(self) -> None:
        self._schemas: dict[int, Schema] = {}
        self._channels: dict[int, Channel] = {}
        self._counts: dict[int, int] = {}
        self._chunks: list[ChunkIndex] = []
        self._attachments: list[AttachmentIndex] = []
        self._metadata: list[MetadataIndex] = []

    @property
    def empty(self) -> bool:
        """Whether the file has neither chunks nor metadata nor attachments."""
        return not (self._chunks or self._metadata or self._attachments)

    @property
    def messages(self) -> int:
        """Messages in the chunks so far, without those for viewers."""
        return message_count(self._channels, self._counts)

    def add_channels(self, schemas: dict[int, Schema], channels: dict[int, Channel]) -> None:
        """Add channels and their schemas.

        A channel whose schema is lost is left out: readers that use the index fail on it. Schema 0 means that a channel
        has none.
        """
        self._schemas.update(schemas)
        known = {0, *self._schemas}
        self._channels |= {number: channel for number, channel in channels.items() if channel.schema_id in known}

    def knows(self, channels: Iterable[int]) -> bool:
        """Whether all these channels are known."""
        return all(channel in self._channels for channel in channels)

    def add_chunk(
        self, header: ChunkHeader, raw: RawRecord, counted: dict[int, tuple[int, int]], index_length: int
    ) -> None:
        """Add a chunk; `counted`: channel → number of its messages and offset of its index, 0 if it has none."""
        for channel, (count, _) in counted.items():
            self._counts[channel] = self._counts.get(channel, 0) + count
        self._chunks.append(
            ChunkIndex(
                chunk_length=raw.end - raw.at,
                chunk_start_offset=raw.at,
                compression=header.compression,
                compressed_size=raw.end - header.packed,
                message_end_time=header.last_ns,
                message_index_length=index_length,
                message_index_offsets={channel: place for channel, (_, place) in counted.items() if place},
                message_start_time=header.first_ns,
                uncompressed_size=header.size,
            )
        )

    def add_attachment_or_metadata(self, record: Attachment | Metadata, raw: RawRecord) -> None:
        """Add an attachment or a metadata record."""
        length = raw.end - raw.at
        if isinstance(record, Metadata):
            self._metadata.append(MetadataIndex(raw.at, length, record.name))
            return
        self._attachments.append(
            AttachmentIndex(
                offset=raw.at,
                length=length,
                log_time=record.log_time,
                create_time=record.create_time,
                data_size=len(record.data),
                name=record.name,
                media_type=record.media_type,
            )
        )

    def tail(self, at: int, checksum: int, metadata: dict[str, dict[str, str]]) -> bytes:
        """Build everything from offset `at`, where the messages end, to the end of the file.

        `checksum` is the checksum of the file up to there; `metadata` are records to be added, by name.
        """
        builder = RecordBuilder()
        for name, fields in metadata.items():
            begin = builder.count
            Metadata(name, fields).write(builder)
            self._metadata.append(MetadataIndex(at + begin, builder.count - begin, name))
        data = bytes_of(builder)
        DataEnd(zlib.crc32(data, checksum)).write(builder)
        data += bytes_of(builder)
        return data + self._summary(at + len(data))

    def _summary(self, start: int) -> bytes:
        builder, offsets = RecordBuilder(), []
        groups: list[tuple[int, Iterable[Any]]] = [
            (Opcode.SCHEMA, self._schemas.values()),
            (Opcode.CHANNEL, self._channels.values()),
            (Opcode.STATISTICS, [self._statistics()]),
            (Opcode.CHUNK_INDEX, self._chunks),
            (Opcode.ATTACHMENT_INDEX, self._attachments),
            (Opcode.METADATA_INDEX, self._metadata),
        ]
        for opcode, records in groups:
            group = builder.count
            for record in records:
                record.write(builder)
            if builder.count > group:
                offsets.append(SummaryOffset(opcode, start + group, builder.count - group))
        offset_start = start + builder.count
        for offset in offsets:
            offset.write(builder)
        return _closed(builder, start, offset_start)

    def _statistics(self) -> Statistics:
        return Statistics(
            attachment_count=len(self._attachments),
            channel_count=len(self._channels),
            channel_message_counts=self._counts,
            chunk_count=len(self._chunks),
            message_count=sum(self._counts.values()),
            metadata_count=len(self._metadata),
            message_start_time=min((chunk.message_start_time for chunk in self._chunks), default=0),
            message_end_time=max((chunk.message_end_time for chunk in self._chunks), default=0),
            schema_count=len(self._schemas),
        )


def message_count(channels: Mapping[int, Channel], counts: Mapping[int, int]) -> int:
    """Messages of all channels, without those for viewers."""
    return sum(count for number, count in counts.items() if not is_derived(channels[number].metadata))


def _closed(builder: RecordBuilder, start: int, offset_start: int) -> bytes:
    """The summary with its footer, whose checksum covers the summary and the footer before it."""
    summary = bytes_of(builder)
    Footer(start, offset_start, 0).write(builder)
    footer = bytes_of(builder)
    checksum = zlib.crc32(summary + footer[:-4])
    return summary + footer[:-4] + checksum.to_bytes(4, "little") + MCAP0_MAGIC
