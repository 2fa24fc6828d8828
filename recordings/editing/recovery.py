"""Repairs a recording in place: it gets the index that it lacks, and loses what is damaged.

Whole chunks stay where they are, so that a hundred megabytes take less than a second. Nothing is made up: a chunk
counts when its checksum does.
"""

import mmap
import struct
import zlib
from dataclasses import dataclass, field
from pathlib import Path

from mcap.opcode import Opcode
from mcap.records import Attachment, Metadata
from mcap.writer import MCAP0_MAGIC

from recordings.container.chunks import BROKEN, RECORD_HEADER
from recordings.container.manifest import MANIFEST, RESULT
from recordings.container.mcap_file import stream_of, summary_is_whole, summary_of
from recordings.container.mcap_writer import CHUNK_BYTES
from recordings.container.partial_file import locked
from recordings.container.raw_records import (
    DAMAGED,
    PRIVATE,
    RawChunk,
    RawRecord,
    chunk_header,
    content_of,
    damaged_chunks,
    index_bytes,
    index_counts,
    raw_chunks_of,
    raw_records_of,
    unpacked,
)
from recordings.container.sealed_metadata import is_sealed
from recordings.container.summary_builder import SummaryBuilder, message_count
from schemas.errors import TouchlineError


@dataclass(frozen=True, slots=True)
class RecoverySummary:
    """What a repair did."""

    path: Path
    """The file, by the name it has now."""
    repaired: bool
    """False where nothing was to be done."""
    messages: int
    """In the file now, without those that are there for viewers alone."""
    cut: int
    """Bytes at its end that were no whole record."""
    rest: Path | None
    """Where they were put, where they may be more than the chunk that was being written."""
    damaged: int
    """Records that were left out because their checksum did not fit."""


def recover(path: Path) -> RecoverySummary:
    """Repair a file in place; a `*.mcap.part` gets the name of a finished one, where no other has it.

    Raises:
        TouchlineError: it cannot be read or written, is being written, is not MCAP, or holds nothing that is whole.
    """
    try:
        with locked(path):
            done, plan = _examine(path)
            if plan is not None:
                _execute(path, plan)
            name = _finished_name(path)
        return RecoverySummary(
            path=name,
            repaired=plan is not None,
            messages=done.messages,
            cut=done.cut,
            rest=plan.rest[0] if plan is not None and plan.rest is not None else None,
            damaged=done.damaged,
        )
    except OSError as error:
        raise TouchlineError(f"{path}: {error.strerror}; give the path of a recording that can be written") from None


@dataclass(slots=True)
class _Plan:
    """What has to be written where; the file ends behind the tail."""

    patches: list[tuple[int, bytes]]
    end: int
    tail: bytes
    rest: tuple[Path, bytes] | None


@dataclass(slots=True)
class _Findings:
    """What is in the file."""

    was_intact: bool
    end: int = 0
    """Of what stays."""
    messages: int = 0
    cut: int = 0
    cut_chunks: bool = False
    """What is cut off holds whole chunks, whose channels or schemas are lost."""
    damaged: int = 0
    indexes: bytes = b""
    """Of the last chunk, to be written anew."""
    patches: list[tuple[int, bytes]] = field(default_factory=list)


def _examine(path: Path) -> tuple[_Findings, _Plan | None]:
    """What is in a file, and what has to be written so that it is whole; nothing where it is."""
    with path.open("r+b") as file:
        if file.read(len(MCAP0_MAGIC)) != MCAP0_MAGIC:
            raise TouchlineError(f"{path}: not a recording; give an *.mcap or *.mcap.part file")
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
            repair = _Repair(path, content)
            found = repair.examine()
            return found, None if found.was_intact else repair.plan(found)


def _execute(path: Path, plan: _Plan) -> None:
    if plan.rest is not None:
        plan.rest[0].write_bytes(plan.rest[1])
    with path.open("r+b") as file:
        for at, patch in plan.patches:
            file.seek(at)
            file.write(patch)
        file.seek(plan.end)
        file.write(plan.tail)
        file.truncate()


def _finished_name(path: Path) -> Path:
    """The file, by the name of a finished one where that is free."""
    if path.suffix != ".part" or path.with_suffix("").exists():
        return path
    return path.rename(path.with_suffix(""))


class _Repair:
    """Looks through one file, and plans what is to be written."""

    def __init__(self, path: Path, content: mmap.mmap) -> None:
        self._path, self._content, self._size = path, content, len(content)
        self._summary = SummaryBuilder()

    def examine(self) -> _Findings:
        """Find out what is whole."""
        summary = summary_of(self._content, self._size) if summary_is_whole(self._content, self._size) else None
        known: list[int] = []
        if summary is not None:
            self._summary.add_channels(summary.schemas, summary.channels)
            known = sorted(
                [chunk.chunk_start_offset for chunk in summary.chunk_indexes]
                + [attachment.offset for attachment in summary.attachment_indexes]
                + [metadata.offset for metadata in summary.metadata_indexes]
            )
        raw_records = list(raw_records_of(self._content, known))
        found = _Findings(was_intact=summary is not None and self._is_intact(raw_records))
        if found.was_intact:
            assert summary is not None and summary.statistics is not None
            found.messages = message_count(summary.channels, summary.statistics.channel_message_counts)
            return found
        self._examine_records(
            raw_records, known, found, finished=bool(raw_records) and raw_records[-1].opcode == Opcode.DATA_END
        )
        found.messages = self._summary.messages
        return found

    def plan(self, found: _Findings) -> _Plan:
        """What to write so that the file is whole again."""
        if self._summary.empty:
            raise TouchlineError(f"{self._path}: cut off before its first whole record; nothing in it can be recovered")
        rest = None
        if found.cut > CHUNK_BYTES or found.cut_chunks:
            rest = self._path.with_name(self._path.name + ".rest"), self._content[self._size - found.cut :]
        note = {"cut_bytes": str(found.cut), "damaged_records": str(found.damaged)}
        checksum = self._checksum(found)
        tail = found.indexes + self._summary.tail(found.end + len(found.indexes), checksum, note)
        return _Plan(found.patches, found.end, tail, rest)

    def _is_intact(self, raw_records: list[RawRecord]) -> bool:
        """Whether the data section has the checksum that its end says; one that says none is looked through."""
        if not raw_records or raw_records[-1].opcode != Opcode.DATA_END:
            return False
        (expected,) = struct.unpack_from("<I", self._content, raw_records[-1].content)
        with memoryview(self._content) as view:
            return bool(expected) and zlib.crc32(view[: raw_records[-1].at]) == expected

    def _examine_records(
        self, raw_records: list[RawRecord], known: list[int], found: _Findings, *, finished: bool
    ) -> None:
        """Take in what is whole, chunk by chunk, and note what has to be written over what is not."""
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
                except BROKEN:  # a chunk without a checksum
                    damaged.add(raw.at)
                if raw.at in damaged:
                    self._leave_out(found, raw, *chunk.indexes)
                elif not is_known:
                    found.cut, found.end, found.cut_chunks = self._size - raw.at, raw.at, True
                    return
            elif raw.opcode in (Opcode.ATTACHMENT, Opcode.METADATA):
                self._keep_attachment_or_metadata(raw, found)
            elif raw.opcode == DAMAGED and raw.at not in in_chunks:
                self._leave_out(found, raw)
        if last is not None and last not in damaged:
            found.end = chunks[last].raw.end  # its indexes are written anew, as one of them may be missing

    def _leave_out(self, found: _Findings, *raw_records: RawRecord) -> None:
        """Have readers pass over records."""
        found.damaged += 1
        found.patches += [(raw.at, RECORD_HEADER.pack(PRIVATE, raw.end - raw.content)) for raw in raw_records]

    def _keep_chunk(self, chunk: RawChunk, found: _Findings, *, trusted: bool, is_last: bool) -> bool:
        """Whether channels and schemas of all its messages are known; without `trusted` indexes it is read."""
        counted = index_counts(self._content, chunk)
        if trusted and not is_last and not chunk.broken and self._summary.knows(counted):
            self._add(chunk.raw, counted, chunk.end - chunk.raw.end)
            return True
        content = content_of(unpacked(self._content, chunk.raw))
        self._summary.add_channels(content.schemas, content.channels)
        if not self._summary.knows(content.indexes):
            return False
        written, places = index_bytes(content.indexes, chunk.raw.end)
        if is_last:
            found.indexes = written
        elif len(written) != chunk.end - chunk.raw.end:
            written, places = b"", {}  # no room for them: readers find what they look for by reading the chunk
            found.patches += [
                (index.at, RECORD_HEADER.pack(PRIVATE, index.end - index.content)) for index in chunk.indexes
            ]
        elif self._content[chunk.raw.end : chunk.end] != written:
            found.patches.append((chunk.raw.end, written))
        counted = {channel: (len(index.records), places.get(channel, 0)) for channel, index in content.indexes.items()}
        self._add(chunk.raw, counted, len(written))
        return True

    def _add(self, raw: RawRecord, counted: dict[int, tuple[int, int]], index_length: int) -> None:
        self._summary.add_chunk(chunk_header(self._content, raw), raw, counted, index_length)

    def _keep_attachment_or_metadata(self, raw: RawRecord, found: _Findings) -> None:
        """Take in an attachment or metadata; a result that counts messages which are gone is left out."""
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
        if isinstance(record, Metadata) and record.name == RESULT and found.damaged:
            found.patches.append((raw.at, RECORD_HEADER.pack(PRIVATE, raw.end - raw.content)))
        else:
            self._summary.add_attachment_or_metadata(record, raw)

    def _checksum(self, found: _Findings) -> int:
        """Of the data section as it will be, up to what is written anew."""
        checksum, at = 0, 0
        with memoryview(self._content) as view:
            for place, patch in sorted(found.patches):
                checksum = zlib.crc32(patch, zlib.crc32(view[at:place], checksum))
                at = place + len(patch)
            return zlib.crc32(found.indexes, zlib.crc32(view[at : found.end], checksum))
