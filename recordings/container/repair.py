"""Examines a file for damage and plans its repair in place.

Undamaged chunks are not moved. No data is made up: a chunk is kept only if its checksum is right.
"""

import mmap
import struct
import zlib
from dataclasses import dataclass, field
from pathlib import Path

from mcap.opcode import Opcode
from mcap.records import Attachment, Metadata
from mcap.writer import MCAP0_MAGIC

from recordings.container.chunks import BROKEN, PRIVATE, RECORD_HEADER
from recordings.container.environment import library
from recordings.container.manifest import DAMAGED_RECORDS, MANIFEST, RECOVERED, RESULT, Result
from recordings.container.mcap_file import stream_of, summary_is_whole, summary_of
from recordings.container.mcap_writer import CHUNK_BYTES
from recordings.container.raw_records import (
    DAMAGED,
    EXTENT,
    RawChunk,
    RawRecord,
    chunk_header,
    content_of,
    damaged_chunks,
    index_bytes,
    index_counts,
    index_extent,
    raw_chunks_of,
    raw_records_of,
    unpacked,
)
from recordings.container.record_search import record_places
from recordings.container.sealed_metadata import from_metadata, is_sealed, sealed, to_metadata
from recordings.container.summary_builder import SummaryBuilder, message_count
from schemas.errors import TouchlineError


@dataclass(slots=True)
class RepairPlan:
    """Bytes to write, by offset; the file ends with the tail."""

    patches: list[tuple[int, bytes]]
    end: int
    tail: bytes
    rest: tuple[Path, bytes] | None


@dataclass(slots=True)
class Findings:
    """What an examination of the file has found."""

    was_intact: bool
    end: int = 0
    """Offset at which the part that is kept ends."""
    messages: int = 0
    cut: int = 0
    cut_chunks: bool = False
    """Whether intact chunks are cut off, because their channels or schemas are lost."""
    damaged: int = 0
    lost_messages: bool = False
    """Whether one of the damaged records may have held messages."""
    result: Result | None = None
    """The result without its counts, if messages that it counts were left out."""
    indexes: bytes = b""
    """Rewritten indexes of the last chunk."""
    patches: list[tuple[int, bytes]] = field(default_factory=list)


def examine(path: Path) -> tuple[Findings, RepairPlan | None]:
    """Examine a file and plan its repair; the plan is None if the file is intact."""
    with path.open("r+b") as file:
        if file.read(len(MCAP0_MAGIC)) != MCAP0_MAGIC:
            raise TouchlineError(f"{path}: not a recording; give an *.mcap file")
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
            repair = _Repair(path, content)
            found = repair.examine()
            note = {"cut_bytes": str(found.cut), DAMAGED_RECORDS: str(found.damaged), "library": library()}
            return found, None if found.was_intact else repair.plan(found, {RECOVERED: sealed(note)})


def execute(path: Path, plan: RepairPlan) -> None:
    """Write what is planned."""
    if plan.rest is not None:
        plan.rest[0].write_bytes(plan.rest[1])
    with path.open("r+b") as file:
        for at, patch in plan.patches:
            file.seek(at)
            file.write(patch)
        file.seek(plan.end)
        file.write(plan.tail)
        file.truncate()


class _Repair:
    """Examines one file and plans its repair."""

    def __init__(self, path: Path, content: mmap.mmap) -> None:
        self._path, self._content, self._size = path, content, len(content)
        self._summary = SummaryBuilder()

    def examine(self) -> Findings:
        """Find the intact and the damaged records."""
        summary = summary_of(self._content, self._size) if summary_is_whole(self._content, self._size) else None
        if summary is None:
            known = record_places(self._content)
        else:
            self._summary.add_channels(summary.schemas, summary.channels)
            known = sorted(
                [chunk.chunk_start_offset for chunk in summary.chunk_indexes]
                + [attachment.offset for attachment in summary.attachment_indexes]
                + [metadata.offset for metadata in summary.metadata_indexes]
            )
        raw_records = list(raw_records_of(self._content, known))
        found = Findings(was_intact=summary is not None and self._is_intact(raw_records))
        if found.was_intact:
            assert summary is not None and summary.statistics is not None
            found.messages = message_count(summary.channels, summary.statistics.channel_message_counts)
            return found
        self._examine_records(
            raw_records, known, found, finished=bool(raw_records) and raw_records[-1].opcode == Opcode.DATA_END
        )
        found.messages = self._summary.messages
        return found

    def plan(self, found: Findings, metadata: dict[str, dict[str, str]]) -> RepairPlan:
        """The bytes to write so that the file is valid; `metadata` are records to be added, by name."""
        if self._summary.empty:
            raise TouchlineError(f"{self._path}: truncated within its first record; nothing in it can be recovered")
        if found.result is not None:
            metadata = {**metadata, RESULT: to_metadata(found.result)}
        tail = found.indexes + self._summary.tail(found.end + len(found.indexes), self._checksum(found), metadata)
        return RepairPlan(found.patches, found.end, tail, self.rest(found))

    def rest(self, found: Findings) -> tuple[Path, bytes] | None:
        """File and bytes of what is cut off; None if it is an unfinished chunk at most."""
        if found.cut <= CHUNK_BYTES and not found.cut_chunks:
            return None
        return self._path.with_name(self._path.name + ".rest"), self._content[self._size - found.cut :]

    def _is_intact(self, raw_records: list[RawRecord]) -> bool:
        """Whether the checksum at the end of the data section is right; False if there is none."""
        if not raw_records or raw_records[-1].opcode != Opcode.DATA_END:
            return False
        (expected,) = struct.unpack_from("<I", self._content, raw_records[-1].content)
        with memoryview(self._content) as view:
            return bool(expected) and zlib.crc32(view[: raw_records[-1].at]) == expected

    def _examine_records(
        self, raw_records: list[RawRecord], known: list[int], found: Findings, *, finished: bool
    ) -> None:
        """Keep the intact records, and note what has to be written over the damaged ones."""
        if finished:
            found.end = raw_records.pop().at
        else:
            found.end = raw_records[-1].end if raw_records else len(MCAP0_MAGIC)
            found.cut = self._size - found.end
        chunks = raw_chunks_of(raw_records, known)
        in_chunks = {index.at for chunk in chunks.values() for index in chunk.indexes}
        damaged = damaged_chunks(self._content, chunks)
        last = max(chunks) if chunks and not finished and chunks[max(chunks)].end == found.end else None
        for raw in raw_records:
            if raw.opcode == Opcode.CHUNK:
                chunk, is_known = chunks[raw.at], False
                try:
                    if raw.at not in damaged:
                        is_known = self._keep_chunk(chunk, found, trusted=not finished, is_last=raw.at == last)
                except BROKEN:  # a damaged chunk without a checksum
                    damaged.add(raw.at)
                if raw.at in damaged:
                    self._leave_out(found, raw, *chunk.indexes, messages=True)
                elif not is_known:
                    found.cut, found.end, found.cut_chunks = self._size - raw.at, raw.at, True
                    return
            elif raw.opcode in (Opcode.ATTACHMENT, Opcode.METADATA):
                self._keep_attachment_or_metadata(raw, found)
            elif raw.opcode == DAMAGED and raw.at not in in_chunks:
                self._leave_out(found, raw, messages=True)
        if last is not None and last not in damaged:
            found.end = chunks[last].raw.end  # its indexes are rewritten, as one of them may be missing

    def _leave_out(self, found: Findings, *raw_records: RawRecord, messages: bool = False) -> None:
        """Make readers ignore records; with `messages`, they may have held some."""
        found.damaged += 1
        found.lost_messages |= messages
        found.patches += [(raw.at, RECORD_HEADER.pack(PRIVATE, raw.end - raw.content)) for raw in raw_records]

    def _keep_chunk(self, chunk: RawChunk, found: Findings, *, trusted: bool, is_last: bool) -> bool:
        """Keep a chunk if the channels and schemas of all its messages are known; returns whether they are.

        If its indexes are not `trusted`, they are compared with its content.
        """
        header = chunk_header(self._content, chunk.raw)
        counted = index_counts(self._content, chunk)
        trusted = trusted and not is_last and not chunk.broken and self._summary.knows(counted)
        if trusted and index_extent(self._content, chunk) == (header.first_ns, header.last_ns):
            self._summary.add_chunk(header, chunk.raw, counted, chunk.end - chunk.raw.end)
            return True
        content = content_of(unpacked(self._content, chunk.raw))
        self._summary.add_channels(content.schemas, content.channels)
        if not self._summary.knows(content.indexes):
            return False
        written, places = index_bytes(content.indexes, chunk.raw.end)
        if is_last:
            found.indexes = written
        elif len(written) != chunk.end - chunk.raw.end:
            written, places = b"", {}  # no room for them: readers have to read the chunk
            found.patches += [
                (index.at, RECORD_HEADER.pack(PRIVATE, index.end - index.content)) for index in chunk.indexes
            ]
        elif self._content[chunk.raw.end : chunk.end] != written:
            found.patches.append((chunk.raw.end, written))
        counted = {channel: (len(index.records), places.get(channel, 0)) for channel, index in content.indexes.items()}
        if content.extent is not None and content.extent != (header.first_ns, header.last_ns):
            header = header._replace(first_ns=content.extent[0], last_ns=content.extent[1])
            found.patches.append((chunk.raw.content, EXTENT.pack(*content.extent)))  # it has no checksum
        self._summary.add_chunk(header, chunk.raw, counted, len(written))
        return True

    def _keep_attachment_or_metadata(self, raw: RawRecord, found: Findings) -> None:
        """Keep an attachment or metadata; a result loses its counts if messages that it counts were left out."""
        record: Attachment | Metadata
        try:
            body = self._content[raw.content : raw.end]
            if raw.opcode == Opcode.ATTACHMENT:
                (expected,) = struct.unpack_from("<I", body, len(body) - 4)
                if expected and zlib.crc32(body[:-4]) != expected:
                    raise ValueError("checksum")
                record = Attachment.read(stream_of(body))
            else:
                record = metadata = Metadata.read(stream_of(body))
                if metadata.name in (MANIFEST, RESULT) and not is_sealed(metadata.metadata):
                    raise ValueError("seal")
        except BROKEN:
            self._leave_out(found, raw)
            return
        if isinstance(record, Metadata) and record.name == RESULT and found.lost_messages:
            found.patches.append((raw.at, RECORD_HEADER.pack(PRIVATE, raw.end - raw.content)))
            found.result = from_metadata(Result, record.metadata).counted({})
        else:
            self._summary.add_attachment_or_metadata(record, raw)

    def _checksum(self, found: Findings) -> int:
        """Checksum of the repaired data section, including the rewritten indexes."""
        checksum, at = 0, 0
        with memoryview(self._content) as view:
            for place, patch in sorted(found.patches):
                checksum = zlib.crc32(patch, zlib.crc32(view[at:place], checksum))
                at = place + len(patch)
            return zlib.crc32(found.indexes, zlib.crc32(view[at : found.end], checksum))
