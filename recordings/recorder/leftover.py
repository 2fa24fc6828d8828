"""What a killed recorder has left of the match that its successor records: its files, and what it knew of the match."""

import mmap
import os
from collections import Counter, deque
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from mcap.opcode import Opcode
from mcap.records import Channel, Metadata, Schema
from mcap.writer import MCAP0_MAGIC

from recordings.container.chunks import BROKEN, MESSAGE, records_in
from recordings.container.manifest import MANIFEST, Manifest
from recordings.container.mcap_file import is_derived, stream_of, summary_is_whole
from recordings.container.numbering import numbered_files, unfinished_files
from recordings.container.partial_file import PartialFile
from recordings.container.raw_records import raw_records_of, unpacked
from recordings.container.repair import cut_to_intact
from recordings.container.sealed_metadata import from_metadata, is_sealed
from recordings.recorder.file_limits import FileLimits
from recordings.recorder.latched_messages import LatchedMessages, LoggedMessage
from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.match_progress import MatchProgress
from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.errors import TouchlineError
from schemas.topic import Party
from schemas.topics import TOPICS
from schemas.wire.message import VERSION

_NEWEST = 20_000
"""Messages that are compared with those of the host: more than the batches hold that the last one may be in."""
SEQUENCES = 0xFFFF_FFFF
"""MCAP has sequence numbers of 32 bits."""

MessageId = tuple[str, int, int]
"""Key, sequence number and time of sending, as in the file."""


def message_id(received: ReceivedMessage) -> MessageId:
    """What identifies a message in the files of a recording."""
    stamp = received.stamp
    if stamp is None:
        return received.key, 0, received.arrived_ns
    return received.key, stamp.sequence & SEQUENCES, stamp.sent_ns


class FileContent:
    """The records of one file, and what they say: complete only after `messages` was read to its end."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.manifest: Manifest | None = None
        self.schemas: dict[int, Schema] = {}
        self.channels: dict[int, Channel] = {}
        self.counts: Counter[str] = Counter()
        """Topic → messages of the channels for viewers."""

    def messages(self) -> Iterator[LoggedMessage]:
        """The messages of the match, in the order of the file.

        Raises:
            TouchlineError: the file is damaged, or of another version.
        """
        try:
            with self.path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
                for raw in raw_records_of(content, []):
                    if raw.opcode == Opcode.CHUNK:
                        yield from self._messages_in(unpacked(content, raw))
                    elif raw.opcode == Opcode.METADATA:
                        self._read_metadata(Metadata.read(stream_of(content[raw.content : raw.end])))
        except BROKEN as error:
            raise TouchlineError(f"{self.path}: cannot be continued, it is damaged inside ({error})") from None

    def _messages_in(self, data: bytes) -> Iterator[LoggedMessage]:
        for opcode, begin, end in records_in(data):
            if opcode == Opcode.MESSAGE:
                number, sequence, log_ns, sent_ns = MESSAGE.unpack_from(data, begin)
                channel = self.channels[number]
                topic = TOPICS.get(channel.metadata.get("topic", ""))
                if topic is None:
                    self.counts[channel.topic] += 1
                else:
                    payload = data[begin + MESSAGE.size : end]
                    yield log_ns, ReceivedMessage(topic, channel.topic, payload, Stamp(sequence, sent_ns, log_ns))
            elif opcode == Opcode.SCHEMA:
                schema = Schema.read(stream_of(data[begin:end]))
                self.schemas[schema.id] = schema
            elif opcode == Opcode.CHANNEL:
                channel = Channel.read(stream_of(data[begin:end]))
                self.channels[channel.id] = channel
                if not is_derived(channel.metadata) and channel.metadata.get("version") != VERSION:
                    raise TouchlineError(f"{self.path}: of another version than {VERSION}; give another --out")

    def _read_metadata(self, record: Metadata) -> None:
        if record.name == MANIFEST and is_sealed(record.metadata):
            self.manifest = from_metadata(Manifest, record.metadata)


@dataclass(slots=True)
class Leftover:
    """The recording as far as the killed recorder has written it."""

    loss_counts: LossCounts = field(default_factory=LossCounts)
    files: list[Path] = field(default_factory=list)
    """The finished files, the oldest first."""
    partial_file: PartialFile | None = None
    """The unfinished file, locked; None if there is none with a message."""
    content: FileContent | None = None
    """The content of the unfinished file."""
    latched: LatchedMessages = field(default_factory=LatchedMessages)
    match: MatchProgress = field(default_factory=MatchProgress)
    newest: deque[MessageId] = field(default_factory=lambda: deque(maxlen=_NEWEST))
    messages: int = 0
    host_ns: int = 0
    """The host's wall time, ns since 1970, of its newest message."""
    part: int = 0
    """Number of the newest file; 0 if there is none."""
    first_ns: int | None = None
    """Log time of the first message of the unfinished file that is not in the files before it."""
    last_ns: int = -1
    """Log time of the newest message."""

    @property
    def is_finished(self) -> bool:
        """Whether there are finished files, and none that is not."""
        return bool(self.files) and self.partial_file is None

    def release(self) -> None:
        """Leave the unfinished file as it is."""
        if self.partial_file is not None:
            self.partial_file.close()

    def read(self, path: Path) -> FileContent:
        """Take in the content of the next file.

        Raises:
            TouchlineError: it is damaged, or of another version.
        """
        content = FileContent(path)
        number, self.first_ns = 0, None
        self.loss_counts.start_file()
        for number, logged in enumerate(content.messages(), start=1):
            manifest = content.manifest
            if manifest is None:
                raise TouchlineError(f"{path}: cannot be continued, it has no manifest; give another --out")
            if number > manifest.latched_count:
                self._add(logged)
            elif not self.part:
                self.latched.update([logged])
        if number and content.manifest is not None:
            if not self.part and content.manifest.part > 1:
                self.loss_counts.forget_missed_before_start()  # they are in files that were not kept
            self.part = content.manifest.part
        return content

    def _add(self, logged: LoggedMessage) -> None:
        log_ns, received = logged
        self.loss_counts.add([logged])
        self.latched.update([logged])
        self.match.update([received])
        self.newest.append(message_id(received))
        self.messages += 1
        self.last_ns = max(self.last_ns, log_ns)
        if self.first_ns is None:
            self.first_ns = log_ns
        if received.topic.writer is Party.HOST and received.stamp is not None:
            self.host_ns = max(self.host_ns, received.stamp.sent_ns)


def find_leftover(path: Path, limits: FileLimits) -> Leftover:
    """Lock and read what a killed recorder has left at a path.

    Raises:
        TouchlineError: another recorder writes there, or what is there is no recording that can be continued.
    """
    several = limits.is_split
    parts = unfinished_files(path) if several else [path.with_name(path.name + ".part")]
    partial_file = PartialFile(parts[-1].with_suffix(""), resume=True) if parts and parts[-1].exists() else None
    leftover = Leftover()
    try:
        if partial_file is not None and _is_finished(partial_file.path):
            partial_file.finish()  # its recorder was killed before it renamed the file
        is_left = partial_file is not None and not partial_file.file.closed and cut_to_intact(partial_file.path)
        leftover.files = numbered_files(path) if several else [path] if path.exists() and not is_left else []
        for file in leftover.files:
            leftover.read(file)
        leftover.loss_counts.start_file()
        if partial_file is not None and is_left:
            partial_file.file.seek(0, os.SEEK_END)
            leftover.content = leftover.read(partial_file.path)
            leftover.partial_file = partial_file
        elif partial_file is not None:
            _discard_if_empty(partial_file)
    except OSError as error:
        raise TouchlineError(f"{parts[-1]}: {error.strerror}; what was written before is readable") from None
    finally:
        if leftover.partial_file is None and partial_file is not None and not partial_file.file.closed:
            partial_file.close()
    return leftover


def _discard_if_empty(partial_file: PartialFile) -> None:
    """Remove a recording that ends before its first message, as `cut_to_intact` has found."""
    if partial_file.file.closed:
        return
    with partial_file.path.open("rb") as file:
        head = file.read(len(MCAP0_MAGIC))
    if MCAP0_MAGIC.startswith(head):
        partial_file.discard()


def _is_finished(path: Path) -> bool:
    with path.open("rb") as file:
        return summary_is_whole(file, path.stat().st_size)
