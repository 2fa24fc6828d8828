"""One part of a recording, which may still be growing: an index of its chunks, and their messages.

Only the offsets of the chunks are read when the file is opened. `grow` reads those that were written since.
"""

import os
import struct
import weakref
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import BinaryIO, NamedTuple

from mcap.opcode import Opcode
from mcap.records import Channel, Metadata
from mcap.writer import MCAP0_MAGIC

from recordings.container.chunks import BROKEN, MESSAGE, RECORD_HEADER, is_known, read_chunk, records_in
from recordings.container.manifest import MANIFEST, RESULT, EndReason
from recordings.container.mcap_file import DAMAGED, stream_of
from recordings.reading.recording import RecordedMessage
from schemas.errors import TouchlineError, os_errors
from schemas.topic import Topic
from schemas.topics import TOPICS

_CHUNK = struct.Struct("<QQ")
"""Times of a chunk's first and last message, in ns."""
_ID = struct.Struct("<H")


class IndexedChunk(NamedTuple):
    """A chunk in the file; times in ns."""

    offset: int
    start_ns: int
    end_ns: int
    channels: set[int]


class KnownChannel(NamedTuple):
    """A channel whose messages are read."""

    key: str
    topic: Topic


class GrowingPart:
    """The chunks of one file; messages on keys that `keep` rejects are left out."""

    def __init__(self, path: Path, keep: Callable[[str], bool]) -> None:
        """Open the file.

        Raises:
            TouchlineError: the file cannot be read, or is not MCAP.
        """
        self._path, self._keep = path, keep
        with os_errors(path, "give the path of a recording"):
            self._file: BinaryIO = path.open("rb")
        self.close = weakref.finalize(self, self._file.close)
        if not MCAP0_MAGIC.startswith(self._file.read(len(MCAP0_MAGIC))):
            self.close()
            raise TouchlineError(f"{path}: not a recording; give an *.mcap file")
        self._scanned_to = len(MCAP0_MAGIC)
        self.chunks: list[IndexedChunk] = []
        self.channels: dict[int, KnownChannel | None] = {}
        """Number → channel; None for one that is left out."""
        self._indexed: set[int] = set()
        self._introducing: list[int] = []
        self.begins_ns: int | None = None
        """Simulated time from which its messages are not repeated; None before its manifest is written."""
        self.continues = False
        """Whether its recorder went on in the next part."""
        self.finished = False
        """Whether the recorder has finished the file."""
        self.grow()

    def grow(self) -> None:
        """Index what was written since.

        Raises:
            TouchlineError: the file is damaged there.
        """
        before, size = len(self.chunks), self._file.seek(0, os.SEEK_END)
        while not self.finished:
            self._file.seek(self._scanned_to)
            head = self._file.read(RECORD_HEADER.size)
            if len(head) < RECORD_HEADER.size:
                break
            opcode, length = RECORD_HEADER.unpack(head)
            if not is_known(opcode) or self._scanned_to + RECORD_HEADER.size + length > size:
                break
            try:
                self._index_record(opcode, length)
            except BROKEN as error:
                raise self._damaged(error) from None
            self._scanned_to += RECORD_HEADER.size + length
        for chunk in self.chunks[before:]:
            if not chunk.channels:  # a repair has left its indexes out
                chunk.channels.update(self._channels_in(chunk))
        for number in self._introducing:
            self._channels_in(self.chunks[number])  # a channel is defined in the first chunk with messages of it
        self._introducing.clear()

    def messages(self, chunk: IndexedChunk) -> list[RecordedMessage]:
        """The messages of a chunk that are not left out.

        Raises:
            TouchlineError: the chunk is damaged.
        """
        found = []
        try:
            for number, (sequence, log_ns, sent_ns), payload in self._messages_of(chunk):
                known = self.channels[number]
                if known is not None:
                    found.append(RecordedMessage(*known, payload, log_ns, sent_ns, sequence))
        except BROKEN as error:
            raise self._damaged(error) from None
        if any(not chunk.start_ns <= message.log_ns <= chunk.end_ns for message in found):
            raise self._damaged("times of a chunk")
        return found

    def _index_record(self, opcode: int, length: int) -> None:
        """Take in a complete record, at whose content the file is positioned."""
        if opcode == Opcode.CHUNK and length >= _CHUNK.size:
            start_ns, end_ns = _CHUNK.unpack(self._file.read(_CHUNK.size))
            self.chunks.append(IndexedChunk(self._scanned_to, start_ns, end_ns, set()))
        elif opcode == Opcode.MESSAGE_INDEX and self.chunks and length >= _ID.size:
            channel = _ID.unpack(self._file.read(_ID.size))[0]
            self.chunks[-1].channels.add(channel)
            if channel not in self._indexed:
                self._indexed.add(channel)
                self._introducing.append(len(self.chunks) - 1)
        elif opcode == Opcode.CHANNEL:
            self._add_channel(Channel.read(stream_of(self._file.read(length))))
        elif opcode == Opcode.METADATA:
            record = Metadata.read(stream_of(self._file.read(length)))
            if record.name == MANIFEST:
                self.begins_ns = int(record.metadata.get("begins_ns", "0"))
            elif record.name == RESULT:
                self.continues = record.metadata.get("ended") == EndReason.CONTINUED
        elif opcode == Opcode.FOOTER:
            self.finished = True

    def _channels_in(self, chunk: IndexedChunk) -> set[int]:
        """The channels of a chunk's messages."""
        try:
            return {number for number, _, _ in self._messages_of(chunk)}
        except BROKEN as error:
            raise self._damaged(error) from None

    def _messages_of(self, chunk: IndexedChunk) -> Iterator[tuple[int, tuple[int, int, int], bytes]]:
        """Yield channel, sequence number with log time and time of sending, and payload; new channels are noted."""
        data = read_chunk(self._file, chunk.offset)
        for opcode, begin, end in records_in(data):
            if opcode == Opcode.MESSAGE:
                channel, *numbers = MESSAGE.unpack_from(data, begin)
                yield channel, tuple(numbers), data[begin + MESSAGE.size : end]
            elif opcode == Opcode.CHANNEL:
                self._add_channel(Channel.read(stream_of(data[begin:end])))

    def _damaged(self, why: object) -> TouchlineError:
        return TouchlineError(f"{self._path}: {DAMAGED.format(why)}")

    def _add_channel(self, channel: Channel) -> None:
        topic = TOPICS.get(channel.metadata.get("topic", ""))
        is_kept = topic is not None and topic.message is not None and self._keep(channel.topic)
        self.channels[channel.id] = KnownChannel(channel.topic, topic) if topic is not None and is_kept else None
