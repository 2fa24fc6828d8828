"""Repairs a recording: its intact records replace it, with a new index. No data is made up."""

import mmap
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain, count
from pathlib import Path
from typing import IO, cast

from mcap.records import Attachment, Channel, DataEnd, McapRecord, Message, Metadata, Schema
from mcap.stream_reader import StreamReader
from mcap.summary import Summary
from mcap.writer import MCAP0_MAGIC

from recordings.container.chunks import BROKEN
from recordings.container.environment import library
from recordings.container.manifest import DAMAGED_RECORDS, RECOVERED, RESULT, Result
from recordings.container.mcap_file import is_derived, summary_is_whole, summary_of
from recordings.container.mcap_writer import CHUNK_BYTES, mcap_writer
from recordings.container.parts import locked
from recordings.container.sealed_metadata import from_metadata, is_sealed, sealed, to_metadata
from recordings.editing.intact_records import Findings, chunks_are_intact, intact_records, profile_of
from runtime.process.whole_file import written_whole
from schemas.errors import TouchlineError, os_errors


@dataclass(frozen=True, slots=True)
class RecoverySummary:
    """The result of a repair."""

    path: Path
    repaired: bool
    """False if the file was undamaged."""
    messages: int
    """Messages in the repaired file, without those for viewers."""
    cut: int = 0
    """Bytes at the end that hold no complete record."""
    damaged: int = 0
    """Damaged records that were left out."""
    original: Path | None = None
    """The damaged file, if more than an unfinished chunk was left out."""


def recover(path: Path) -> RecoverySummary:
    """Repair a file.

    Raises:
        TouchlineError: the file cannot be read or written, is being recorded, is not MCAP, or has no intact record.
    """
    with os_errors(path, "give the path of a recording that can be written"), locked(path), path.open("rb") as file:
        if file.read(len(MCAP0_MAGIC)) != MCAP0_MAGIC:
            raise TouchlineError(f"{path}: not a recording; give an *.mcap file")
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
            return _recover(path, content)


def _recover(path: Path, content: mmap.mmap) -> RecoverySummary:
    size = len(content)
    summary = summary_of(content, size) if summary_is_whole(content, size) else None
    if summary is not None and summary.statistics is not None and _is_intact(content):
        derived = {number for number, channel in summary.channels.items() if is_derived(channel.metadata)}
        counts = summary.statistics.channel_message_counts
        messages = sum(count for number, count in counts.items() if number not in derived)
        return RecoverySummary(path, repaired=False, messages=messages)
    with written_whole(path) as draft:
        with draft.open("wb") as file:
            copy = _Copy(file)
            found = copy.fill(content, summary)
        if copy.is_empty:
            raise TouchlineError(f"{path}: truncated within its first record; nothing in it can be recovered")
        original = None
        if found.damaged or copy.cut > CHUNK_BYTES:
            original = path.rename(_free_name(path))
    return RecoverySummary(path, True, copy.messages, copy.cut, found.damaged, original)


def _free_name(path: Path) -> Path:
    """The name of a damaged file after its repair, which no file has: `x.mcap.damaged`, `x.mcap.damaged-2`, …"""
    name = path.with_name(f"{path.name}.damaged")
    numbered = (name.with_name(f"{name.name}-{number}") for number in count(2))
    return next(free for free in chain([name], numbered) if not free.exists())


def _is_intact(content: mmap.mmap) -> bool:
    """Whether the checksum at the end of the data section is right; where a writer has left it out, those of chunks."""
    content.seek(0)
    reader = StreamReader(
        cast(IO[bytes], content), emit_chunks=True, validate_crcs=True, record_size_limit=len(content)
    )
    try:
        for record in reader.records:
            if isinstance(record, DataEnd):
                return bool(record.data_section_crc) or chunks_are_intact(content)
        return False
    except BROKEN:
        return False


class _Copy:
    """The repaired file. A channel is opened with its first message."""

    def __init__(self, file: IO[bytes]) -> None:
        self._mcap = mcap_writer(file)
        self._schemas: dict[int, Schema] = {}
        self._channels: dict[int, Channel] = {}
        self._opened_schemas = {0: 0}
        """Number in the damaged file → number in this one; 0 stands for no schema."""
        self._opened: dict[int, int] = {}
        self.messages = 0
        self.cut = 0
        """Bytes at the end of the damaged file that hold no complete record."""
        self.is_empty = True

    def fill(self, content: mmap.mmap, summary: Summary | None) -> Findings:
        """Copy what is intact, and note what is not."""
        found = Findings()
        self._mcap.start(profile=profile_of(content), library=library())
        if summary is not None:
            self._schemas, self._channels = dict(summary.schemas), dict(summary.channels)
        damaged = 0
        for record in intact_records(content, summary, found):
            self.is_empty = False
            if isinstance(record, Metadata) and record.name == RECOVERED and is_sealed(record.metadata):
                damaged += int(record.metadata.get(DAMAGED_RECORDS, "0"))  # of earlier repairs
            elif isinstance(record, Metadata):
                self._add_metadata(record, found)
            elif isinstance(record, Attachment):
                times = record.create_time, record.log_time
                self._mcap.add_attachment(*times, record.name, record.media_type, record.data)
            elif not self._add_chunk(record):
                found.damaged += 1
                found.lost_messages = True
        self.cut = 0 if found.finished else len(content) - found.end
        note = {"cut_bytes": str(self.cut), DAMAGED_RECORDS: str(damaged + found.damaged), "library": library()}
        self._add_metadata(Metadata(RECOVERED, sealed(note)), found)
        self._mcap.finish()  # type: ignore[no-untyped-call]
        return found

    def _add_metadata(self, record: Metadata, found: Findings) -> None:
        """Add metadata; a result loses its counts if messages that it counts were left out."""
        metadata = record.metadata
        if record.name == RESULT and found.lost_messages:
            metadata = to_metadata(from_metadata(Result, metadata).counted({}))
        self._mcap.flush()  # type: ignore[no-untyped-call]
        self._mcap.add_metadata(record.name, metadata)

    def _add_chunk(self, records: Iterable[McapRecord]) -> bool:
        """Add the messages of a chunk; returns whether channels and schemas of all its messages are known."""
        messages = []
        for record in records:
            if isinstance(record, Schema):
                self._schemas[record.id] = record
            elif isinstance(record, Channel):
                self._channels[record.id] = record
            elif isinstance(record, Message):
                messages.append(record)
        if not all(self._open(number) for number in dict.fromkeys(message.channel_id for message in messages)):
            return False
        for message in messages:
            number = self._opened[message.channel_id]
            self._mcap.add_message(number, message.log_time, message.data, message.publish_time, message.sequence)
            self.messages += not is_derived(self._channels[message.channel_id].metadata)
        return True

    def _open(self, number: int) -> bool:
        """Open a channel unless it is open; returns whether it and its schema are known."""
        if number in self._opened:
            return True
        channel = self._channels.get(number)
        if channel is None or not (channel.schema_id in self._opened_schemas or channel.schema_id in self._schemas):
            return False
        if channel.schema_id not in self._opened_schemas:
            schema = self._schemas[channel.schema_id]
            opened = self._mcap.register_schema(schema.name, schema.encoding, schema.data)
            self._opened_schemas[channel.schema_id] = opened
        schema_id = self._opened_schemas[channel.schema_id]
        encoding, metadata = channel.message_encoding, channel.metadata
        self._opened[number] = self._mcap.register_channel(channel.topic, encoding, schema_id, metadata)
        return True
