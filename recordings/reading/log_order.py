"""The messages of MCAP files of any writer, in the order of log time."""

import heapq
import re
from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import chain
from operator import attrgetter
from pathlib import Path
from typing import NamedTuple

from mcap.opcode import Opcode
from mcap.reader import SeekingReader

from recordings.container.chunks import BROKEN, MESSAGE, read_chunk, records_in
from recordings.container.manifest import MANIFEST
from recordings.container.mcap_file import DAMAGED, ROW, ChannelRecord, McapFile, open_mcap_file
from schemas.errors import TouchlineError
from schemas.natural_order import natural_order

_WINDOW = 10_000
"""Messages of a file without an index among which the next one is looked for."""
_log_ns = attrgetter("log_ns")


class LogMessage(NamedTuple):
    """A message of any channel."""

    key: str
    topic: ChannelRecord
    payload: bytes
    log_ns: int
    """Log time in ns since the first message of the log."""
    sent_ns: int
    """Publish time in ns, as in the file."""
    sequence: int

    @property
    def time(self) -> float:
        """Log time in s since the first message of the log."""
        return self.log_ns / 1e9


class Log:
    """One or several MCAP files of any writer, whose times are counted from the first message of all."""

    def __init__(self, files: Sequence[McapFile], key_of: Callable[[str], str | None]) -> None:
        """`key_of` returns the key of a topic, None for one that is left out."""
        self.files = files
        self._keys = [
            {number: key for number, channel in file.channels.items() if (key := key_of(channel.key)) is not None}
            for file in files
        ]
        self.channels = [
            (keys[number], file.channels[number])
            for file, keys in zip(files, self._keys, strict=True)
            for number in keys
        ]
        """Key and channel of each channel that is not left out."""
        counted = [channel for file in files for channel in file.channels.values() if channel.messages]
        self.base_ns = min((channel.first_ns for channel in counted), default=0)
        """Log time of the first message, in ns, as in the file."""
        self.end_ns = max((channel.last_ns for channel in counted), default=0) - self.base_ns
        """Time of the last message, in ns since the first."""

    def merged_channels(self) -> list[tuple[str, ChannelRecord]]:
        """Key and channel, sorted by key; channels of one key, encoding and schema count together."""
        found: dict[tuple[str, str, str], ChannelRecord] = {}
        for key, channel in self.channels:
            kind = key, channel.encoding, channel.schema_name
            known = found.get(kind)
            if known is None or not known.messages:
                found[kind] = channel
            elif channel.messages:
                first_ns, last_ns = min(known.first_ns, channel.first_ns), max(known.last_ns, channel.last_ns)
                total = known.messages + channel.messages
                found[kind] = replace(known, messages=total, first_ns=first_ns, last_ns=last_ns)
        return sorted(((key, one) for (key, *_), one in found.items()), key=lambda pair: natural_order(pair[0]))

    def messages(self, start_ns: int = 0) -> Iterator[LogMessage]:
        """Yield the messages from this time on, in ns since the first one.

        In a file without an index, a message more than `_WINDOW` messages from its place stays there.

        Raises:
            TouchlineError: a file is damaged inside.
        """
        start = start_ns + self.base_ns
        parts = [
            self._indexed(file, keys, start) if file.indexed else self._streamed(file, keys, start)
            for file, keys in zip(self.files, self._keys, strict=True)
            if keys
        ]
        return parts[0] if len(parts) == 1 else heapq.merge(*parts, key=_log_ns)

    def _indexed(self, file: McapFile, keys: dict[int, str], start: int) -> Iterator[LogMessage]:
        """Chunk by chunk; what a later chunk may precede is kept until that one is read."""
        kept: list[LogMessage] = []
        with file.path.open("rb") as content:
            try:
                summary = SeekingReader(content, record_size_limit=file.size).get_summary()
                chunks = summary.chunk_indexes if summary is not None else []
                places = sorted(
                    (one.message_start_time, one.chunk_start_offset) for one in chunks if one.message_end_time >= start
                )
                for (_, at), (limit, _) in zip(places, [*places[1:], (1 << 65, 0)], strict=True):
                    kept += self._in_chunk(read_chunk(content, at), file, keys, start)
                    kept.sort(key=_log_ns)
                    ready = bisect_left(kept, limit - self.base_ns, key=_log_ns)
                    yield from kept[:ready]
                    del kept[:ready]
            except BROKEN as error:
                raise TouchlineError(f"{file.path}: {DAMAGED.format(error)}") from None

    def _in_chunk(self, data: bytes, file: McapFile, keys: dict[int, str], start: int) -> Iterator[LogMessage]:
        base, channels, unpack, head = self.base_ns, file.channels, MESSAGE.unpack_from, MESSAGE.size
        for opcode, begin, end in records_in(data):
            if opcode == Opcode.MESSAGE:
                number, sequence, log_ns, sent_ns = unpack(data, begin)
                if log_ns >= start and number in keys:
                    yield LogMessage(
                        keys[number], channels[number], data[begin + head : end], log_ns - base, sent_ns, sequence
                    )

    def _streamed(self, file: McapFile, keys: dict[int, str], start: int) -> Iterator[LogMessage]:
        waiting: list[tuple[int, int, LogMessage]] = []
        topics = {file.channels[number].key for number in keys}
        for place, (_, one) in enumerate(file.messages(topics, start)):
            if one.channel_id in keys:
                channel, log_ns = file.channels[one.channel_id], one.log_time - self.base_ns
                found = LogMessage(keys[one.channel_id], channel, one.data, log_ns, one.publish_time, one.sequence)
                heapq.heappush(waiting, (log_ns, place, found))
            if len(waiting) > _WINDOW:
                yield heapq.heappop(waiting)[2]
        while waiting:
            yield heapq.heappop(waiting)[2]


def seconds_ns(seconds: float) -> int:
    """A time in s as messages of a log have it, in ns."""
    return round(seconds * 1e9)


def files_of(paths: Sequence[Path]) -> list[Path]:
    """The MCAP files at these paths; a folder, as a ROS 2 bag is, stands for those in it.

    Raises:
        TouchlineError: a folder has none.
    """
    return list(chain.from_iterable(_in_folder(path) if path.is_dir() else [path] for path in paths))


def _in_folder(folder: Path) -> list[Path]:
    found = sorted(folder.glob("*.mcap"))
    if not found:
        raise TouchlineError(
            f"{folder}: has no *.mcap; convert a bag of another storage with `ros2 bag convert` or `rosbags-convert`, "
            "and decompress *.mcap.zstd with `zstd -d`"
        )
    metadata = folder / "metadata.yaml"
    if metadata.exists() and re.search(
        r"compression_mode:\s*['\"]?message", metadata.read_text("utf-8", "replace"), re.I
    ):
        raise TouchlineError(
            f"{folder}: each message is compressed; convert it with `ros2 bag convert` to no compression"
        )
    return found


def is_match(paths: Sequence[Path]) -> bool:
    """Whether this is the recording of a match, which one path names, or a file that cannot be anything else.

    Raises:
        TouchlineError: a file cannot be read, or is not MCAP.
    """
    if len(paths) != 1 or paths[0].is_dir():
        return False
    file = open_mcap_file(paths[0])
    return not file.channels or MANIFEST in file.metadata or any(ROW in one.metadata for one in file.channels.values())


def check_no_match(log: Log) -> None:
    """Check that no file is the recording of a match, whose times are simulated ones.

    Raises:
        TouchlineError: one is.
    """
    for file in log.files:
        if MANIFEST in file.metadata:
            raise TouchlineError(
                f"{file.path}: is the recording of a match, which is read alone; give this file, of several parts the "
                "first"
            )


def open_log(paths: Sequence[Path], key_of: Callable[[str], str | None] = lambda topic: topic) -> Log:
    """Open MCAP files of any writer, and bag folders.

    Raises:
        TouchlineError: a file cannot be read, is not MCAP, or no message is left.
    """
    log = Log([open_mcap_file(path) for path in files_of(paths)], key_of)
    if not any(channel.messages for _, channel in log.channels):
        raise TouchlineError(f"{paths[0]}: no message is selected; `touchline info {paths[0]}` lists the keys")
    return log
