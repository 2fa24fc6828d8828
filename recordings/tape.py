"""The messages of a recording as a tape: wound to any moment at once, and read on while the file is still written.

The file is looked through for the places of its chunks alone. What was written since is found by looking again: a part
that a recorder still writes, and that is renamed when it is finished, is one tape to its end.
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
from mcap.records import Channel, Chunk
from mcap.stream_reader import get_chunk_data_stream
from mcap.writer import MCAP0_MAGIC

from recordings.container import BROKEN, DAMAGED
from recordings.reader import Recorded
from schemas.errors import TouchlineError
from schemas.topic import Topic
from schemas.topics import TOPICS

_HEAD = struct.Struct("<BQ")
"""Opcode and length of a record."""
_CHUNK = struct.Struct("<QQ")
"""Times of a chunk's first and last message."""
_MESSAGE = struct.Struct("<HIQQ")
"""Channel, number on it, log time and publish time of a message."""
_ID = struct.Struct("<H")
_OPCODES = frozenset(int(opcode) for opcode in Opcode)


class _Place(NamedTuple):
    """A chunk in the file; times in ns."""

    offset: int
    length: int
    start_ns: int
    end_ns: int
    channels: set[int]


class Tape:
    """A recording that stands at one message; `keep` says which keys are on it."""

    def __init__(self, path: Path, keep: Callable[[str], bool] = lambda _: True) -> None:
        """Look through the file.

        Raises:
            TouchlineError: it cannot be read, or is not MCAP.
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
        self._looked = len(MCAP0_MAGIC)
        self._places: list[_Place] = []
        self._ends: list[int] = []
        self._channels: dict[int, tuple[str, Topic] | None] = {}
        self._indexed: set[int] = set()
        self._introducing: list[int] = []
        self._place = 0
        self._messages: list[Recorded] = []
        self._next = 0
        self.finished = False
        """The recorder has finished the file: nothing will be added."""
        self.grow()
        self._load(0)

    @property
    def start_ns(self) -> int:
        """Simulated time of the first message, in ns; 0 when there is none."""
        return self._places[0].start_ns if self._places else 0

    @property
    def end_ns(self) -> int:
        """Simulated time of the newest message, in ns."""
        return self._ends[-1] if self._ends else 0

    def grow(self) -> bool:
        """Look for what was written since; whether anything was.

        Raises:
            TouchlineError: the file is damaged there.
        """
        before, size = len(self._places), self._size()
        while not self.finished:
            self._file.seek(self._looked)
            head = self._file.read(_HEAD.size)
            if len(head) < _HEAD.size:
                break
            opcode, length = _HEAD.unpack(head)
            if opcode not in _OPCODES or self._looked + _HEAD.size + length > size:
                break
            try:
                self._note(opcode, length)
            except BROKEN as error:
                raise self._damaged(error) from None
            self._looked += _HEAD.size + length
        for place in self._introducing:
            self._read(place)  # what is known of a channel stands in the first chunk that has messages of it
        self._introducing.clear()
        return len(self._places) > before

    def peek(self) -> Recorded | None:
        """The message that the tape stands at; nothing at its end.

        Raises:
            TouchlineError: the file is damaged there.
        """
        while self._next >= len(self._messages):
            if self._place + 1 >= len(self._places):
                return None
            self._load(self._place + 1)
        return self._messages[self._next]

    def skip(self) -> None:
        """Go on behind the message that it stands at."""
        self._next += 1

    def rewind(self) -> None:
        """Stand before the first message.

        Raises:
            TouchlineError: the file is damaged there.
        """
        self._load(0)

    def seek(self, ns: int) -> None:
        """Stand before the first message at `ns` or later.

        Raises:
            TouchlineError: the file is damaged there.
        """
        place = 0
        while place < len(self._places) and self._ends[place] < ns:
            place = bisect_right(self._ends, ns - 1, lo=place)
        self._load(min(place, max(0, len(self._places) - 1)))
        while (message := self.peek()) is not None and message.log_ns < ns:
            self.skip()

    def standing(self, ns: int, of: Callable[[Topic], bool]) -> list[Recorded]:
        """The newest message before `ns` of every key of these topics, in the order of the tape.

        Raises:
            TouchlineError: the file is damaged there.
        """
        found: dict[int, tuple[int, int, Recorded]] = {}
        done: set[int] = set()
        for place in range(min(bisect_right(self._ends, ns), len(self._places) - 1), -1, -1):
            wanted = self._places[place].channels - done
            if not wanted:
                continue
            number = -1
            for number, (channel, message) in enumerate(self._read(place)):
                if channel in wanted and message.log_ns < ns:
                    found[channel] = place, number, message
            done.update(found)
            done.update(channel for channel in wanted if self._is_left_out(channel, of))
        kept = sorted(one for channel, one in found.items() if not self._is_left_out(channel, of))
        return [message for _, _, message in kept]

    def _is_left_out(self, channel: int, of: Callable[[Topic], bool]) -> bool:
        known = self._channels.get(channel)
        return known is None or not of(known[1])

    def _size(self) -> int:
        self._file.seek(0, 2)
        return self._file.tell()

    def _note(self, opcode: int, length: int) -> None:
        """A record that is whole; the file stands at its content."""
        if opcode == Opcode.CHUNK and length >= _CHUNK.size:
            start_ns, end_ns = _CHUNK.unpack(self._file.read(_CHUNK.size))
            self._places.append(_Place(self._looked + _HEAD.size, length, start_ns, end_ns, set()))
            self._ends.append(max(end_ns, self._ends[-1] if self._ends else end_ns))
        elif opcode == Opcode.MESSAGE_INDEX and self._places and length >= _ID.size:
            channel = _ID.unpack(self._file.read(_ID.size))[0]
            self._places[-1].channels.add(channel)
            if channel not in self._indexed:
                self._indexed.add(channel)
                self._introducing.append(len(self._places) - 1)
        elif opcode == Opcode.CHANNEL:
            self._meet(Channel.read(ReadDataStream(BytesIO(self._file.read(length)))))
        elif opcode == Opcode.FOOTER:
            self.finished = True

    def _load(self, place: int) -> None:
        is_there = place < len(self._places)
        self._place, self._next = place if is_there else place - 1, 0
        self._messages = [message for _, message in self._read(place)] if is_there else []

    def _read(self, place: int) -> list[tuple[int, Recorded]]:
        """The kept messages of a chunk, each with the number of its channel."""
        here = self._places[place]
        self._file.seek(here.offset)
        try:
            chunk = Chunk.read(ReadDataStream(self._file))
            stream, length = get_chunk_data_stream(chunk, validate_crc=True)
            messages = self._messages_in(stream.read(length))
        except BROKEN as error:
            raise self._damaged(error) from None
        if any(not here.start_ns <= message.log_ns <= here.end_ns for _, message in messages):
            raise self._damaged("times of a chunk")
        return messages

    def _damaged(self, why: object) -> TouchlineError:
        return TouchlineError(f"{self._path}: {DAMAGED.format(why)}")

    def _messages_in(self, data: bytes) -> list[tuple[int, Recorded]]:
        at, messages, channels = 0, [], self._channels
        while at < len(data):
            opcode, length = _HEAD.unpack_from(data, at)
            at += _HEAD.size
            if opcode == Opcode.MESSAGE:
                channel, sequence, log_ns, sent_ns = _MESSAGE.unpack_from(data, at)
                known = channels[channel]
                if known is not None:
                    payload = data[at + _MESSAGE.size : at + length]
                    messages.append((channel, Recorded(known[0], known[1], payload, log_ns, sent_ns, sequence)))
            elif opcode == Opcode.CHANNEL:
                self._meet(Channel.read(ReadDataStream(BytesIO(data[at : at + length]))))
            at += length
        return messages

    def _meet(self, channel: Channel) -> None:
        topic = TOPICS.get(channel.metadata.get("topic", ""))
        is_kept = topic is not None and topic.message is not None and self._keep(channel.topic)
        self._channels[channel.id] = (channel.topic, topic) if topic is not None and is_kept else None
