"""Reads an MCAP file: by its index, or, if it is truncated, record by record up to the end."""

import mmap
import struct
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import IO, cast

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Attachment, Channel, Chunk, ChunkIndex, Footer, McapRecord, Message, Metadata, Schema
from mcap.stream_reader import StreamReader, breakup_chunk
from mcap.summary import Summary
from mcap.writer import MCAP0_MAGIC

from recordings.container.chunks import BROKEN, MESSAGE, read_chunk, records_in, unpacked
from recordings.container.manifest import MANIFEST, MANIFEST_COPY
from recordings.container.sealed_metadata import is_sealed
from schemas.errors import TouchlineError, os_errors

DAMAGED = "damaged inside ({}); use another copy of it, or leave out the damaged parts with `touchline recover`"
END_NS = 1 << 64
"""Later than the time of any message."""
_FOOTER = struct.Struct("<BQQQI")
"""Opcode, length, start of the summary, start of its offsets, checksum of the summary."""
DERIVED = "derived"
"""Key in the metadata of a channel whose messages are derived from other channels, for viewers."""

ROW = "row"
"""Key in the metadata of a channel of a match: its row in the table of topics."""


@dataclass(slots=True)
class ChannelRecord:
    """One channel with its number of messages and the times of its first and last one, in ns of simulated time."""

    key: str
    metadata: dict[str, str]
    messages: int = 0
    first_ns: int = 0
    last_ns: int = 0
    encoding: str = "json"
    """Encoding of its messages, as MCAP names it."""
    schema: Schema | None = None

    @property
    def topic(self) -> str:
        """Name of its topic in the topic table."""
        return self.metadata.get("topic", "")

    @property
    def schema_name(self) -> str:
        """Name of its schema; empty without one."""
        return self.schema.name if self.schema is not None else ""

    @property
    def start(self) -> float:
        """Time of its first message, s."""
        return self.first_ns / 1e9

    @property
    def end(self) -> float:
        """Time of its last message, s."""
        return self.last_ns / 1e9

    def extend(self, log_ns: int) -> None:
        """Count a message."""
        self.first_ns = min(self.first_ns, log_ns) if self.messages else log_ns
        self.last_ns = max(self.last_ns, log_ns)
        self.messages += 1


@dataclass(slots=True)
class McapFile:
    """The content of a file, apart from its messages, which `messages` reads."""

    path: Path
    complete: bool = True
    """Whether the file was finished by its writer."""
    indexed: bool = True
    """Whether chunks and their times are known; without, the file is read from its beginning."""
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    channels: dict[int, ChannelRecord] = field(default_factory=dict)

    @property
    def size(self) -> int:
        """Bytes of the file."""
        return self.path.stat().st_size

    def add_metadata(self, record: Metadata) -> None:
        """Add a metadata record; of a name, or a manifest and its copy, the last intact one counts."""
        name = MANIFEST if record.name == MANIFEST_COPY else record.name
        if name not in self.metadata or is_sealed(record.metadata):
            self.metadata[name] = record.metadata

    def messages(self, keys: set[str], start_ns: int = 0, end_ns: int = END_NS) -> Iterator[tuple[str, Message]]:
        """Yield key and message, in the order of the file, from `start_ns` up to but not including `end_ns`.

        Raises:
            TouchlineError: the file is finished, and damaged.
        """
        with self.path.open("rb") as file:
            if not self.indexed:
                yield from self._streamed(file, keys, start_ns, end_ns)
                return
            try:
                yield from self._indexed(file, keys, start_ns, end_ns)
            except BROKEN as error:
                raise TouchlineError(f"{self.path}: {DAMAGED.format(error)}") from None

    def _indexed(self, file: IO[bytes], keys: set[str], start_ns: int, end_ns: int) -> Iterator[tuple[str, Message]]:
        """Read only the chunks that can hold such messages according to the summary."""
        summary = SeekingReader(file).get_summary()
        wanted = {number: channel.key for number, channel in self.channels.items() if channel.key in keys}
        for index in summary.chunk_indexes if summary is not None else ():
            is_in_time = index.message_start_time < end_ns and index.message_end_time >= start_ns
            places = index.message_index_offsets  # MCAP lets a writer leave them out; then the chunk is read
            if not is_in_time or (places and wanted.keys().isdisjoint(places)):
                continue
            data = read_chunk(file, index.chunk_start_offset)
            for opcode, begin, end in records_in(data):
                if opcode == Opcode.MESSAGE:
                    channel, sequence, log_ns, sent_ns = MESSAGE.unpack_from(data, begin)
                    if channel in wanted and start_ns <= log_ns < end_ns:
                        payload = data[begin + MESSAGE.size : end]
                        yield wanted[channel], Message(channel, log_ns, payload, sent_ns, sequence)

    def _streamed(self, file: IO[bytes], keys: set[str], start_ns: int, end_ns: int) -> Iterator[tuple[str, Message]]:
        known: dict[int, str] = {}  # a growing file has more channels than when it was opened
        for record in _records(file, self.path.stat().st_size):
            if isinstance(record, Channel):
                known.setdefault(record.id, record.topic)
            elif isinstance(record, Message) and start_ns <= record.log_time < end_ns:
                key = known[record.channel_id]
                if key in keys:
                    yield key, record


def open_mcap_file(path: Path) -> McapFile:
    """Read everything but the messages of a file.

    Raises:
        TouchlineError: the file cannot be read, or is not MCAP.
    """
    with os_errors(path, "give the path of a recording"), path.open("rb") as file:
        if not MCAP0_MAGIC.startswith(file.read(len(MCAP0_MAGIC))):
            raise TouchlineError(f"{path}: not a recording; give an *.mcap file")
        return _from_summary(path, file) or _from_records(path, file)


def _from_summary(path: Path, file: IO[bytes]) -> McapFile | None:
    """Read a file by its summary; None if it has no valid summary, because it is truncated."""
    size = path.stat().st_size
    summary = summary_of(file, size) if summary_is_whole(file, size) else None
    if summary is None or summary.statistics is None:
        return None
    counts, channels = summary.statistics.channel_message_counts, summary.channels
    is_described = {*counts} <= {*channels} and {one.schema_id for one in channels.values()} <= {0, *summary.schemas}
    if not is_described or (summary.statistics.message_count and not summary.chunk_indexes):
        return None  # some writers write no chunks, no index of them, or no channels and schemas into the summary
    file.seek(0)
    try:
        reader = SeekingReader(file, record_size_limit=size)
        mcap_file = McapFile(path)
        for record in reader.iter_metadata():
            mcap_file.add_metadata(record)
        mcap_file.attachments = {record.name: record.data for record in reader.iter_attachments()}
        chunks: dict[int, dict[int, list[int]]] = {}
        for number, channel in channels.items():
            extent = _extent(file, summary, number, chunks)
            schema = summary.schemas.get(channel.schema_id)
            mcap_file.channels[number] = ChannelRecord(
                channel.topic, channel.metadata, counts.get(number, 0), *extent, channel.message_encoding, schema
            )
    except BROKEN as error:
        raise TouchlineError(f"{path}: {DAMAGED.format(error)}") from None
    return mcap_file


def is_derived(metadata: Mapping[str, str]) -> bool:
    """Whether a channel with this metadata exists only for viewers."""
    return DERIVED in metadata


def summary_is_whole(file: IO[bytes] | mmap.mmap, size: int) -> bool:
    """Whether there is a summary and its checksum is right. Writers may leave the checksum out."""
    end = size - len(MCAP0_MAGIC) - _FOOTER.size
    if end < len(MCAP0_MAGIC):
        return False
    file.seek(end)
    footer = file.read(_FOOTER.size)
    opcode, length, start, _, expected = _FOOTER.unpack(footer)
    if file.read() != MCAP0_MAGIC or (opcode, length) != (Opcode.FOOTER, _FOOTER.size - 9) or not 0 < start <= end:
        return False
    file.seek(start)
    return expected in (0, zlib.crc32(file.read(end - start) + footer[:-4]))


def summary_of(file: IO[bytes] | mmap.mmap, size: int) -> Summary | None:
    """The summary; None if it cannot be read."""
    file.seek(0)
    try:
        summary = SeekingReader(cast(IO[bytes], file), record_size_limit=size).get_summary()
    except BROKEN:
        return None
    return summary if summary is not None and summary.statistics is not None else None


def stream_of(content: bytes) -> ReadDataStream:
    """Return a stream to read a record from."""
    return ReadDataStream(BytesIO(content))


def _extent(file: IO[bytes], summary: Summary, channel: int, read: dict[int, dict[int, list[int]]]) -> tuple[int, int]:
    """Times of a channel's first and last message, from the chunks that may have these; `read` caches chunks."""
    chunks = [
        index
        for index in summary.chunk_indexes
        if channel in (index.message_index_offsets or _times(file, index, read))
    ]
    first, last = END_NS if chunks else 0, 0
    for index in sorted(chunks, key=lambda one: one.message_start_time):
        if index.message_start_time >= first:
            break
        first = min(first, *_times(file, index, read)[channel])
    for index in sorted(chunks, key=lambda one: one.message_end_time, reverse=True):
        if index.message_end_time <= last:
            break
        last = max(last, *_times(file, index, read)[channel])
    return first, last


def _times(file: IO[bytes], chunk: ChunkIndex, read: dict[int, dict[int, list[int]]]) -> dict[int, list[int]]:
    """Channel → log times of its messages in a chunk. Read from the chunk, as indexes have no checksum."""
    at = chunk.chunk_start_offset
    if at not in read:
        times: dict[int, list[int]] = {}
        data = read_chunk(file, at)
        for opcode, begin, _ in records_in(data):
            if opcode == Opcode.MESSAGE:
                number, _, log_ns, _ = MESSAGE.unpack_from(data, begin)
                times.setdefault(number, []).append(log_ns)
        read[at] = times
    return read[at]


def _from_records(path: Path, file: IO[bytes]) -> McapFile:
    """Read a file without an index, or a truncated one up to its end."""
    mcap_file = McapFile(path, complete=False, indexed=False)
    schemas: dict[int, Schema] = {}
    has_summary = summary_is_whole(file, path.stat().st_size)
    file.seek(0)
    for record in _records(file, path.stat().st_size):
        match record:
            case Metadata():
                mcap_file.add_metadata(record)
            case Attachment():
                mcap_file.attachments[record.name] = record.data
            case Schema():
                schemas[record.id] = record
            case Channel(id=number, topic=topic, metadata=metadata, message_encoding=encoding):
                schema = schemas.get(record.schema_id)
                mcap_file.channels.setdefault(number, ChannelRecord(topic, metadata, encoding=encoding, schema=schema))
            case Message():
                mcap_file.channels[record.channel_id].extend(record.log_time)
            case Footer():
                mcap_file.complete = has_summary or not record.summary_start
    return mcap_file


def _records(file: IO[bytes], size: int) -> Iterator[McapRecord]:
    """Yield all records up to the first one that is incomplete, or a message without a channel."""
    channels = set()
    try:
        for outer in StreamReader(file, emit_chunks=True, validate_crcs=True, record_size_limit=size).records:
            for record in breakup_chunk(unpacked(outer), validate_crc=True) if isinstance(outer, Chunk) else (outer,):
                if isinstance(record, Channel):
                    channels.add(record.id)
                elif isinstance(record, Message) and record.channel_id not in channels:
                    return
                yield record
    except BROKEN:
        return
