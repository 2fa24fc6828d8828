"""Reads a recording: manifest, result, channels, and its messages, as payloads or decoded."""

from collections import Counter, deque
from collections.abc import Iterator
from datetime import datetime
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, NamedTuple

from recordings.container.applied_changes import changes_in
from recordings.container.lineup import Lineup
from recordings.container.manifest import DAMAGED_RECORDS, MANIFEST, RECOVERED, RESULT, Manifest, Result
from recordings.container.mcap_file import END_NS, ChannelRecord, McapFile, is_derived
from recordings.container.parted_file import open_parts
from recordings.container.sealed_metadata import digest, from_metadata, is_sealed
from runtime.bus.contract import ReceivedMessage, Stamp
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup
from schemas.natural_order import natural_order
from schemas.topic import Topic
from schemas.topics import APPLIED, TOPICS, WORLD
from schemas.wire.message import VERSION, BadMessageError, valid


class RecordedMessage(NamedTuple):
    """A message of a recording, decoded on demand."""

    key: str
    topic: Topic
    payload: bytes
    log_ns: int
    """Simulated time in ns."""
    sent_ns: int
    """Wall time at which it was sent, ns since 1970."""
    sequence: int
    """Sequence number of the sender on this key, modulo 2³²."""

    @property
    def stamp(self) -> Stamp:
        """Sequence number and times of the message."""
        return Stamp(self.sequence, self.sent_ns, self.log_ns)

    @property
    def time(self) -> float:
        """Simulated time in s."""
        return self.log_ns / 1e9

    def received(self) -> ReceivedMessage:
        """The message as it came from the bus."""
        return ReceivedMessage(self.topic, self.key, self.payload, self.stamp)

    def message(self) -> Any:
        """The validated message.

        Raises:
            BadMessageError: the payload is not a message of its topic.
        """
        assert self.topic.message is not None
        return self.topic.message.decode(self.payload)


_LATEST_NS = 2**31 * 10**9
"""ns of simulated time that no match reaches, and that the stamps of other formats do not hold."""
_LAST_S = 3.0
"""Simulated time before the last message of a key in which its last valid message is searched."""


class Recording:
    """An opened recording. No file stays open between calls."""

    def __init__(self, mcap_file: McapFile, manifest: Manifest, result: Result | None) -> None:
        self.mcap_file = mcap_file
        self.path = mcap_file.path
        self.complete = mcap_file.complete
        """Whether the recorder finished the file."""
        self.manifest = manifest
        self.result = result
        """How match and recording ended; None in a truncated file."""
        self.attachments = {
            name: content
            for name, content in mcap_file.attachments.items()
            if digest(content) == manifest.attached.get(name, digest(content))
        }
        """Attachments whose content is unchanged, by name."""
        self.damaged = sorted(({*manifest.attached, *mcap_file.attachments}) - {*self.attachments})
        """Attachments that are missing or have changed."""
        self.unreadable: Counter[str] = Counter()
        """Key → payloads that `decoded` skipped because they are not valid messages."""
        self._topics = {
            channel.key: topic
            for channel in mcap_file.channels.values()
            if (topic := TOPICS.get(channel.topic)) is not None and topic.message is not None
        }

    @property
    def setup(self) -> Setup:
        """The setup of the match.

        Raises:
            TouchlineError: the recording has none.
        """
        if self.manifest.setup is None:
            raise TouchlineError(
                f"{self.path}: its manifest has no setup, so pitch and teams are unknown; "
                "start the recorder while the host is running"
            )
        return self.manifest.setup

    def extent_of_worlds(self) -> tuple[float, float]:
        """Simulated times of the first and the last world, in s.

        Raises:
            TouchlineError: the recording has no world.
        """
        for channel in self.channels:
            if channel.key == WORLD.key and channel.messages:
                return channel.start, channel.end
        raise TouchlineError(f"{self.path}: has no world, so there is nothing to measure; record the key world")

    def last(self, key: str) -> Any:
        """The last valid message of a key, of the last seconds in which it has messages; None if there is none."""
        channel = next((one for one in self.channels if one.key == key and one.messages), None)
        if channel is None:
            return None
        newest = deque(self.decoded(key, start=max(0.0, channel.end - _LAST_S)), maxlen=1)
        return newest[0][1] if newest else None

    def lineup(self) -> Lineup:
        """The robots that took part at any time.

        Raises:
            TouchlineError: the file is damaged inside.
        """
        lineup = Lineup.of(self.manifest.setup)
        for recorded in self.messages(APPLIED.key):
            if changes_in(recorded.payload).robots is not None and (applied := valid(recorded.message)) is not None:
                lineup = lineup.changed(applied.robots or [])
        return lineup

    @property
    def damaged_records(self) -> int:
        """Damaged records that a repair has left out."""
        note = self.mcap_file.metadata.get(RECOVERED, {})
        return self.manifest.damaged_records + (int(note.get(DAMAGED_RECORDS, "0")) if is_sealed(note) else 0)

    @property
    def channels(self) -> list[ChannelRecord]:
        """The keys of this recording, sorted."""
        facts = (one for one in self.mcap_file.channels.values() if not is_derived(one.metadata))
        return sorted(facts, key=lambda channel: natural_order(channel.key))

    @property
    def drawn(self) -> dict[str, int]:
        """Topic → messages, of the channels for viewers."""
        channels = sorted(self.mcap_file.channels.values(), key=lambda channel: natural_order(channel.key))
        return {channel.key: channel.messages for channel in channels if is_derived(channel.metadata)}

    def messages(self, *keys: str, start: float | None = None, end: float | None = None) -> Iterator[RecordedMessage]:
        """Yield messages in recorded order, from `start` up to but not including `end`, in s of simulated time.

        `keys` are keys or patterns as returned by `Topic.fill()`, such as `robot/*/command`; by default all keys whose
        topic this version knows.

        Raises:
            TouchlineError: the file is damaged inside.
        """
        wanted = {key for key in self._topics if not keys or any(fnmatchcase(key, pattern) for pattern in keys)}
        for key, message in self.mcap_file.messages(wanted, nanoseconds(start, 0), nanoseconds(end, END_NS)):
            topic = self._topics[key]
            yield RecordedMessage(key, topic, message.data, message.log_time, message.publish_time, message.sequence)

    def decoded(
        self, *keys: str, start: float | None = None, end: float | None = None
    ) -> Iterator[tuple[RecordedMessage, Any]]:
        """Like `messages`, with each message decoded; invalid payloads are counted in `unreadable` and skipped."""
        for recorded in self.messages(*keys, start=start, end=end):
            try:
                yield recorded, recorded.message()
            except BadMessageError:
                self.unreadable[recorded.key] += 1


def open_recording(path: Path, *, whole: bool = False) -> Recording:
    """Open a recording, with all its parts. A truncated file is read up to its end, unless it has to be `whole`.

    Raises:
        TouchlineError: no such file, not a recording, truncated before its manifest, or of another major version.
    """
    mcap_file = open_parts(path)
    if whole and not mcap_file.complete:
        raise TouchlineError(f"{path}: truncated file, its recorder did not finish it; recover it first")
    if MANIFEST not in mcap_file.metadata:
        if not mcap_file.complete:
            raise TouchlineError(f"{path}: truncated file, it ends before its manifest; nothing in it can be read")
        raise TouchlineError(f"{path}: an MCAP file without a manifest, not a recording of a match; record one")
    if not mcap_file.complete and not is_sealed(mcap_file.metadata.get(RESULT, {})):
        mcap_file.metadata.pop(RESULT, None)  # the file ends within it
    for name in (MANIFEST, RESULT):
        if name in mcap_file.metadata and not is_sealed(mcap_file.metadata[name]):
            raise TouchlineError(f"{path}: its {name} is damaged, bytes of it have changed; use another copy of it")
    try:
        manifest = from_metadata(Manifest, mcap_file.metadata[MANIFEST])
        result = from_metadata(Result, mcap_file.metadata[RESULT]) if RESULT in mcap_file.metadata else None
        datetime.fromisoformat(manifest.started)
    except (TouchlineError, ValueError) as error:
        _check_version(path, mcap_file.metadata[MANIFEST].get("contract", ""))
        raise TouchlineError(f"{path}: its manifest or result is damaged: {error}") from None
    _check_version(path, manifest.contract)
    late = next((one for one in mcap_file.channels.values() if one.last_ns >= _LATEST_NS), None)
    if late is not None:
        raise TouchlineError(
            f"{path}: {late.key} has a message at {late.end:.3g} s; no match lasts so long, use another copy"
        )
    return Recording(mcap_file, manifest, result)


def _check_version(path: Path, theirs: str) -> None:
    if theirs.partition(".")[0] != VERSION.partition(".")[0]:
        raise TouchlineError(
            f"{path}: recorded with messages of version {theirs}, this program reads {VERSION}; "
            "open it with the program that recorded it"
        )


def is_time(seconds: float) -> bool:
    """Whether a file can have a message at this time, in s: log times have 64 bits, and count ns."""
    return 0.0 <= seconds <= 2**64 / 1e9


def nanoseconds(seconds: float | None, otherwise: int) -> int:
    """A simulated time in s as messages are filed under it, in ns; `otherwise` without one."""
    return round(seconds * 1e9) if seconds is not None else otherwise
