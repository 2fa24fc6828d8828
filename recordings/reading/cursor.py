"""A cursor over the messages of a recording: seeks to any time at once, and follows a recording that is still growing.

A recording of several parts is followed from one to the next.
"""

from bisect import bisect_right
from collections.abc import Callable
from pathlib import Path

from recordings.container.parts import part_path, parts_of
from recordings.reading.growing_part import GrowingPart, IndexedChunk
from recordings.reading.recording import RecordedMessage
from schemas.topic import Topic


class Cursor:
    """A position in a recording; messages on keys that `keep` rejects are left out."""

    def __init__(self, path: Path, keep: Callable[[str], bool] = lambda _: True) -> None:
        """Open all parts that are there.

        Raises:
            TouchlineError: a file cannot be read, or is not MCAP.
        """
        self._path, self._keep = path, keep
        self._parts: list[GrowingPart] = []
        self._chunks: list[tuple[GrowingPart, IndexedChunk]] = []
        self._ends: list[int] = []
        """Simulated time of the newest message up to and including each chunk, in ns."""
        self._stops: dict[GrowingPart, int] = {}
        """Part → simulated time in ns at which the next one begins."""
        self._chunk = self._next = 0
        self._messages: list[RecordedMessage] = []
        for part in parts_of(path) or [path]:
            self._add(GrowingPart(part, keep))
        self._load_chunk(0)

    @property
    def start_ns(self) -> int:
        """Simulated time of the first message, in ns; 0 if there is none."""
        return self._chunks[0][1].start_ns if self._chunks else 0

    @property
    def end_ns(self) -> int:
        """Simulated time of the newest message, in ns."""
        return self._ends[-1] if self._ends else 0

    @property
    def finished(self) -> bool:
        """Whether the recorder has finished the recording."""
        return self.is_closed and not self._parts[-1].continues

    @property
    def is_closed(self) -> bool:
        """Whether the newest part is finished."""
        return self._parts[-1].finished

    def close(self) -> None:
        """Close the files."""
        for part in self._parts:
            part.close()

    def grow(self) -> bool:
        """Read what was written since; returns whether a chunk was added.

        Raises:
            TouchlineError: the recording is damaged there.
        """
        before = len(self._chunks)
        next_part = part_path(self._path, len(self._parts) + 1)
        goes_on = next_part.exists()  # what was written before that is read first
        newest = self._parts[-1]
        known = len(newest.chunks)
        newest.grow()
        self._add_chunks(newest, known)
        if goes_on:
            self._add(GrowingPart(next_part, self._keep))
        return len(self._chunks) > before

    def peek(self) -> RecordedMessage | None:
        """The next message; None at the end.

        Raises:
            TouchlineError: the recording is damaged there.
        """
        while self._next >= len(self._messages):
            if self._chunk + 1 >= len(self._chunks):
                return None
            self._load_chunk(self._chunk + 1)
        return self._messages[self._next]

    def skip(self) -> None:
        """Move past the next message."""
        self._next += 1

    def seek(self, ns: int) -> None:
        """Move to the first message at `ns` or later.

        Raises:
            TouchlineError: the recording is damaged there.
        """
        number = bisect_right(self._ends, ns - 1)
        self._load_chunk(min(number, max(0, len(self._chunks) - 1)))
        while (message := self.peek()) is not None and message.log_ns < ns:
            self.skip()

    def latched(self, ns: int, is_latched: Callable[[Topic], bool]) -> list[RecordedMessage]:
        """The newest message before `ns` on each key of the latched topics, in the order of the recording.

        Raises:
            TouchlineError: the recording is damaged there.
        """
        found: dict[str, tuple[int, int, RecordedMessage]] = {}
        for number in range(min(bisect_right(self._ends, ns), len(self._chunks) - 1), -1, -1):
            part, chunk = self._chunks[number]
            known = {channel: part.channels.get(channel) for channel in chunk.channels}
            keys = {one.key for one in known.values() if one is not None and is_latched(one.topic)} - found.keys()
            if keys:
                newest = {}
                for position, message in enumerate(self._read(number)):
                    if message.key in keys and message.log_ns < ns:
                        newest[message.key] = number, position, message
                found |= newest
        return [message for _, _, message in sorted(found.values())]

    def _add(self, part: GrowingPart) -> None:
        """Take in the next part; one whose manifest is not written yet is left out."""
        if self._parts:
            if part.begins_ns is None:
                part.close()
                return
            self._stops[self._parts[-1]] = part.begins_ns
        self._parts.append(part)
        self._add_chunks(part, 0)

    def _add_chunks(self, part: GrowingPart, known: int) -> None:
        for chunk in part.chunks[known:]:
            self._chunks.append((part, chunk))
            self._ends.append(max(chunk.end_ns, self._ends[-1] if self._ends else chunk.end_ns))

    def _load_chunk(self, number: int) -> None:
        is_there = number < len(self._chunks)
        self._chunk, self._next = number if is_there else number - 1, 0
        self._messages = self._read(number) if is_there else []

    def _read(self, number: int) -> list[RecordedMessage]:
        """The messages of a chunk that are not left out and in no other part."""
        part, chunk = self._chunks[number]
        messages = part.messages(chunk)
        begins_ns = part.begins_ns if part is not self._parts[0] else None
        stops_ns = self._stops.get(part)
        if begins_ns is not None and chunk.start_ns < begins_ns:
            messages = [one for one in messages if one.log_ns >= begins_ns]
        if stops_ns is not None and chunk.end_ns >= stops_ns:
            messages = [one for one in messages if one.log_ns < stops_ns]
        return messages
