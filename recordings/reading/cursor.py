"""A cursor over the messages of a recording: seeks to any time at once, and follows a file that is still growing.

Only the offsets of the chunks are read when the file is opened. `grow` reads those that were written since. A file that
is renamed when its recorder finishes it can be read to its end.
"""

import struct
import weakref
from bisect import bisect_right
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import BinaryIO, NamedTuple

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Channel
from mcap.writer import MCAP0_MAGIC

from recordings.container.chunks import BROKEN, MESSAGE, RECORD_HEADER, is_known, read_chunk, records_in
from recordings.container.mcap_file import DAMAGED
from recordings.reading.recording import RecordedMessage
from schemas.errors import TouchlineError
from schemas.topic import Topic
from schemas.topics import TOPICS

_CHUNK = struct.Struct("<QQ")
"""Times of a chunk's first and last message, in ns."""
_ID = struct.Struct("<H")


class _IndexedChunk(NamedTuple):
    """A chunk in the file; times in ns."""

    offset: int
    start_ns: int
    end_ns: int
    channels: set[int]


class Cursor:
    """A position in one file of a recording; messages on keys that `keep` rejects are left out."""

    def __init__(self, path: Path, keep: Callable[[str], bool] = lambda _: True) -> None:
        """Open the file.

        Raises:
            TouchlineError: the file cannot be read, or is not MCAP.
        """
        self._path = path
        self._keep = keep
        try:
            self._file: BinaryIO = path.open("rb")
        except OSError as error:
            raise TouchlineError(f"{path}: {error.strerror}; give the path of a recording") from None
        self.close = weakref.finalize(self, self._file.close)
        if self._file.read(len(MCAP0_MAGIC)) != MCAP0_MAGIC:
            self.close()
            raise TouchlineError(f"{path}: not a recording; give an *.mcap file")
        self._scanned_to = len(MCAP0_MAGIC)
        self._chunks: list[_IndexedChunk] = []
        self._ends: list[int] = []
        self._channels: dict[int, tuple[str, Topic] | None] = {}
        """Number → key, topic and version of the protocol; None for one that is left out."""
        self._indexed: set[int] = set()
        self._introducing: list[int] = []
        self._chunk = 0
        self._messages: list[RecordedMessage] = []
        self._next = 0
        self.finished = False
        """Whether the recorder has finished the file."""
        self.grow()
        self._load_chunk(0)

    @property
    def start_ns(self) -> int:
        """Simulated time of the first message, in ns; 0 if there is none."""
        return self._chunks[0].start_ns if self._chunks else 0

    @property
    def end_ns(self) -> int:
        """Simulated time of the newest message, in ns."""
        return self._ends[-1] if self._ends else 0

    def grow(self) -> bool:
        """Read what was written since; returns whether a chunk was added.

        Raises:
            TouchlineError: the file is damaged there.
        """
        before, size = len(self._chunks), self._size()
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
        for chunk in self._chunks[before:]:
            if not chunk.channels:  # a repair has left its indexes out
                chunk.channels.update(self._channels_in(chunk))
        for number in self._introducing:
            self._read(number)  # a channel is defined in the first chunk with messages of it
        self._introducing.clear()
        return len(self._chunks) > before

    def peek(self) -> RecordedMessage | None:
        """The next message; None at the end.

        Raises:
            TouchlineError: the file is damaged there.
        """
        while self._next >= len(self._messages):
            if self._chunk + 1 >= len(self._chunks):
                return None
            self._load_chunk(self._chunk + 1)
        return self._messages[self._next]

    def skip(self) -> None:
        """Move past the next message."""
        self._next += 1

    def rewind(self) -> None:
        """Move to the first message.

        Raises:
            TouchlineError: the file is damaged there.
        """
        self._load_chunk(0)

    def seek(self, ns: int) -> None:
        """Move to the first message at `ns` or later.

        Raises:
            TouchlineError: the file is damaged there.
        """
        number = 0
        while number < len(self._chunks) and self._ends[number] < ns:
            number = bisect_right(self._ends, ns - 1, lo=number)
        self._load_chunk(min(number, max(0, len(self._chunks) - 1)))
        while (message := self.peek()) is not None and message.log_ns < ns:
            self.skip()

    def latched(self, ns: int, is_latched: Callable[[Topic], bool]) -> list[RecordedMessage]:
        """The newest message before `ns` on each key of the latched topics, in the order of the file.

        Raises:
            TouchlineError: the file is damaged there.
        """
        found: dict[int, tuple[int, int, RecordedMessage]] = {}
        done: set[int] = set()
        for number in range(min(bisect_right(self._ends, ns), len(self._chunks) - 1), -1, -1):
            wanted = self._chunks[number].channels - done
            if not wanted:
                continue
            position = -1
            for position, (channel, message) in enumerate(self._read(number)):
                if channel in wanted and message.log_ns < ns:
                    found[channel] = number, position, message
            done.update(found)
            done.update(channel for channel in wanted if self._is_left_out(channel, is_latched))
        kept = sorted(one for channel, one in found.items() if not self._is_left_out(channel, is_latched))
        return [message for _, _, message in kept]

    def _is_left_out(self, channel: int, is_latched: Callable[[Topic], bool]) -> bool:
        known = self._channels.get(channel)
        return known is None or not is_latched(known[1])

    def _size(self) -> int:
        self._file.seek(0, 2)
        return self._file.tell()

    def _index_record(self, opcode: int, length: int) -> None:
        """Take in a complete record, at whose content the file is positioned."""
        if opcode == Opcode.CHUNK and length >= _CHUNK.size:
            start_ns, end_ns = _CHUNK.unpack(self._file.read(_CHUNK.size))
            self._chunks.append(_IndexedChunk(self._scanned_to, start_ns, end_ns, set()))
            self._ends.append(max(end_ns, self._ends[-1] if self._ends else end_ns))
        elif opcode == Opcode.MESSAGE_INDEX and self._chunks and length >= _ID.size:
            channel = _ID.unpack(self._file.read(_ID.size))[0]
            self._chunks[-1].channels.add(channel)
            if channel not in self._indexed:
                self._indexed.add(channel)
                self._introducing.append(len(self._chunks) - 1)
        elif opcode == Opcode.CHANNEL:
            self._add_channel(Channel.read(ReadDataStream(BytesIO(self._file.read(length)))))
        elif opcode == Opcode.FOOTER:
            self.finished = True

    def _load_chunk(self, number: int) -> None:
        is_there = number < len(self._chunks)
        self._chunk, self._next = number if is_there else number - 1, 0
        self._messages = [message for _, message in self._read(number)] if is_there else []

    def _read(self, number: int) -> list[tuple[int, RecordedMessage]]:
        """The messages of a chunk that are not left out, each with the number of its channel."""
        chunk_index = self._chunks[number]
        try:
            messages = self._messages_in(read_chunk(self._file, chunk_index.offset))
        except BROKEN as error:
            raise self._damaged(error) from None
        if any(not chunk_index.start_ns <= message.log_ns <= chunk_index.end_ns for _, message in messages):
            raise self._damaged("times of a chunk")
        return messages

    def _channels_in(self, chunk: _IndexedChunk) -> set[int]:
        """The channels of a chunk's messages."""
        try:
            data = read_chunk(self._file, chunk.offset)
            channels = set()
            for opcode, begin, end in records_in(data):
                if opcode == Opcode.MESSAGE:
                    channels.add(MESSAGE.unpack_from(data, begin)[0])
                elif opcode == Opcode.CHANNEL:
                    self._add_channel(Channel.read(ReadDataStream(BytesIO(data[begin:end]))))
        except BROKEN as error:
            raise self._damaged(error) from None
        return channels

    def _damaged(self, why: object) -> TouchlineError:
        return TouchlineError(f"{self._path}: {DAMAGED.format(why)}")

    def _messages_in(self, data: bytes) -> list[tuple[int, RecordedMessage]]:
        messages, channels = [], self._channels
        for opcode, begin, end in records_in(data):
            if opcode == Opcode.MESSAGE:
                channel, sequence, log_ns, sent_ns = MESSAGE.unpack_from(data, begin)
                known = channels[channel]
                if known is not None:
                    payload = data[begin + MESSAGE.size : end]
                    recorded = RecordedMessage(*known, payload, log_ns, sent_ns, sequence)
                    messages.append((channel, recorded))
            elif opcode == Opcode.CHANNEL:
                self._add_channel(Channel.read(ReadDataStream(BytesIO(data[begin:end]))))
        return messages

    def _add_channel(self, channel: Channel) -> None:
        topic = TOPICS.get(channel.metadata.get("topic", ""))
        is_kept = topic is not None and topic.message is not None and self._keep(channel.topic)
        self._channels[channel.id] = (channel.topic, topic) if topic is not None and is_kept else None
