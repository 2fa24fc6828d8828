"""The intact records of a damaged recording, in order: reading goes on behind each damaged record."""

import mmap
import struct
import zlib
from collections.abc import Callable, Iterator, Sequence, Set
from dataclasses import dataclass

from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Header, McapRecord, Message, Metadata, Schema
from mcap.stream_reader import breakup_chunk
from mcap.summary import Summary
from mcap.writer import MCAP0_MAGIC

from recordings.container.chunks import BROKEN, PRIVATE, RECORD_HEADER, is_known, unpacked
from recordings.container.manifest import MANIFEST, MANIFEST_COPY, RESULT
from recordings.container.mcap_file import stream_of
from recordings.container.record_search import record_places
from recordings.container.sealed_metadata import is_sealed

_DAMAGED = 0x100
"""Stands for the opcode of a record whose header is damaged; no record has it."""
_IN_DATA = frozenset({Opcode.HEADER, Opcode.CHUNK, Opcode.MESSAGE_INDEX, Opcode.ATTACHMENT, Opcode.METADATA})
"""Records before the end of the data section; all others are in chunks, or after the data section."""
_PLAIN: dict[int, Callable[[bytes], McapRecord]] = {
    Opcode.SCHEMA: lambda content: Schema.read(stream_of(content)),
    Opcode.CHANNEL: lambda content: Channel.read(stream_of(content)),
    Opcode.MESSAGE: lambda content: Message.read(stream_of(content), len(content)),
}
"""Records that a file without chunks has in its data section, too."""
_DATA_END_BYTES = 4


@dataclass(slots=True)
class Findings:
    """What was found so far."""

    end: int = len(MCAP0_MAGIC)
    """Offset of the end of the last complete record."""
    finished: bool = False
    """Whether the end of the data section was reached."""
    damaged: int = 0
    lost_messages: bool = False
    """Whether one of the damaged records may have held messages."""


def intact_records(
    content: mmap.mmap, summary: Summary | None, found: Findings
) -> Iterator[Metadata | Attachment | list[McapRecord]]:
    """Yield metadata, attachments and the records of each chunk; a chunk is intact if its checksum is right.

    `summary`, if the file has one, tells where records begin.
    """
    allowed = _IN_DATA | _PLAIN.keys() if _is_plain(content) else _IN_DATA
    for opcode, begin, end in _records(content, _known_places(content, summary), allowed):
        found.end = end
        try:
            if opcode == Opcode.DATA_END:
                found.finished = True
            elif opcode == Opcode.CHUNK:
                yield breakup_chunk(unpacked(Chunk.read(stream_of(content[begin:end]))), validate_crc=True)
            elif opcode in _PLAIN:
                yield [_PLAIN[opcode](content[begin:end])]
            elif opcode == Opcode.ATTACHMENT:
                yield _attachment(content[begin:end])
            elif opcode == Opcode.METADATA:
                yield _metadata(content[begin:end])
            elif opcode == _DAMAGED:
                raise ValueError("header")
        except BROKEN:
            found.damaged += 1
            found.lost_messages |= opcode in (Opcode.CHUNK, _DAMAGED)


def profile_of(content: mmap.mmap) -> str:
    """The profile in the header of a file, `ros2` of a bag; empty where the header is damaged."""
    try:
        return str(
            Header.read(stream_of(content[len(MCAP0_MAGIC) + RECORD_HEADER.size : _header_end(content)])).profile
        )
    except BROKEN:
        return ""


def chunks_are_intact(content: mmap.mmap) -> bool:
    """Whether all checksums of chunks are right, of a file whose records are complete."""
    found = Findings()
    for _ in intact_records(content, None, found):
        pass
    return found.finished and not found.damaged


def _is_plain(content: mmap.mmap) -> bool:
    """Whether a file begins with messages instead of chunks."""
    second = _header_end(content)
    return second < len(content) and content[second] in _PLAIN


def _header_end(content: mmap.mmap) -> int:
    begin = len(MCAP0_MAGIC) + RECORD_HEADER.size
    if len(content) < begin:
        return len(content)
    return begin + int(RECORD_HEADER.unpack_from(content, len(MCAP0_MAGIC))[1])


def _known_places(content: mmap.mmap, summary: Summary | None) -> list[int]:
    """Offsets at which records begin, in order: by the summary, or by their first bytes."""
    if summary is None:
        return record_places(content)
    places = [chunk.chunk_start_offset for chunk in summary.chunk_indexes]
    places += [attachment.offset for attachment in summary.attachment_indexes]
    return sorted(places + [metadata.offset for metadata in summary.metadata_indexes])


def _records(content: mmap.mmap, known: Sequence[int], allowed: Set[int]) -> Iterator[tuple[int, int, int]]:
    """Yield opcode, begin of the content and end of each record, up to the end of the data or an incomplete record.

    After a record with a damaged header, reading continues at the next of the `known` offsets, and the bytes between
    are one damaged record. A record that is not `allowed` in the data section counts as damaged, too: a bit of its
    opcode has changed.
    """
    at, size = len(MCAP0_MAGIC), len(content)
    places = iter(known)
    place = next(places, None)
    while at + RECORD_HEADER.size <= size:
        while place is not None and place <= at:
            place = next(places, None)
        opcode, length = RECORD_HEADER.unpack_from(content, at)
        begin = at + RECORD_HEADER.size
        at = begin + length
        sound = is_known(opcode)
        if place is not None and (not sound or at > place):
            opcode, at = _DAMAGED, place
        elif not sound or at > size:
            return
        elif not (opcode in allowed or opcode >= PRIVATE or (opcode, length) == (Opcode.DATA_END, _DATA_END_BYTES)):
            opcode = _DAMAGED
        yield opcode, begin, at
        if opcode == Opcode.DATA_END:
            return


def _attachment(content: bytes) -> Attachment:
    (expected,) = struct.unpack_from("<I", content, len(content) - 4)
    if expected and zlib.crc32(content[:-4]) != expected:
        raise ValueError("checksum")
    attachment: Attachment = Attachment.read(stream_of(content))
    return attachment


def _metadata(content: bytes) -> Metadata:
    metadata: Metadata = Metadata.read(stream_of(content))
    if metadata.name in (MANIFEST, MANIFEST_COPY, RESULT) and not is_sealed(metadata.metadata):
        raise ValueError("seal")
    return metadata
