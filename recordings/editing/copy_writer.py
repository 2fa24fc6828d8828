"""Writes a recording from the unchanged messages of another recording."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import TracebackType
from typing import NamedTuple, Self

from recordings.container.attachments import MEDIA_TYPES
from recordings.container.environment import library
from recordings.container.manifest import MANIFEST, RESULT, Manifest, Result
from recordings.container.mcap_file import ChannelRecord
from recordings.container.mcap_writer import mcap_writer
from recordings.container.partial_file import PartialFile
from recordings.container.sealed_metadata import digest, to_metadata
from recordings.recorder.sequence_tracker import SequenceTracker
from recordings.viz.viz_channels import VizChannels
from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.errors import TouchlineError
from schemas.topics import TOPICS


class MessageCopy(NamedTuple):
    """A message to be copied, with the channel of its original."""

    log_ns: int
    channel: ChannelRecord
    payload: bytes
    sent_ns: int
    sequence: int


class CopyWriter:
    """One file. Leaving the context before `finish` removes it."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._partial_file = PartialFile(path)
        self._mcap = mcap_writer(self._partial_file.file)
        self._channels: dict[str, int] = {}
        self._schemas: dict[tuple[str, bytes], int] = {}
        self._trackers: dict[str, SequenceTracker] = {}
        self._messages = 0
        self._viz_channels: VizChannels | None = None

    def begin(self, manifest: Manifest, attachments: dict[str, bytes], latched: int, *, viz: bool) -> None:
        """Write manifest and attachments; the first `latched` messages repeat the state at the beginning of the copy.

        With `viz`, the channels for viewers are written, too.
        """
        if viz and manifest.setup is not None:
            self._viz_channels = VizChannels(self._mcap, manifest.setup)
        attached = {name: digest(content) for name, content in attachments.items()}
        manifest = manifest.model_copy(update={"attached": attached, "latched_count": latched})
        with self._disk_errors_explained():
            self._mcap.start(profile="", library=library())
            self._mcap.add_metadata(MANIFEST, to_metadata(manifest))
            for name, data in attachments.items():
                self._mcap.add_attachment(
                    0, 0, name, MEDIA_TYPES.get(Path(name).suffix, "application/octet-stream"), data
                )
            self._mcap.add_metadata(MANIFEST, to_metadata(manifest))  # again, as in every recording

    def add(self, copy: MessageCopy, *, counted: bool = True) -> None:
        """Write a message; one that is not `counted` is in the counts of another file."""
        channel, stamp = copy.channel, Stamp(copy.sequence, copy.sent_ns, copy.log_ns)
        with self._disk_errors_explained():
            number = self._channels.get(channel.key) or self._open_channel(channel)
            self._mcap.add_message(number, copy.log_ns, copy.payload, copy.sent_ns, copy.sequence)
            topic = TOPICS.get(channel.metadata.get("topic", ""))
            if self._viz_channels is not None and topic is not None:
                self._viz_channels.draw(ReceivedMessage(topic, channel.key, copy.payload, stamp), copy.log_ns)
        self._messages += 1
        if counted:
            self._trackers.setdefault(channel.key, SequenceTracker()).add(stamp, len(copy.payload))

    def finish(self, result: Result | None) -> int:
        """Write the result with the counts of this file, and rename the file; returns its number of messages."""
        with self._disk_errors_explained():
            self._mcap.flush()  # type: ignore[no-untyped-call]
            if result is not None:
                counts = {key: tracker.count() for key, tracker in sorted(self._trackers.items())}
                self._mcap.add_metadata(RESULT, to_metadata(result.counted(counts)))
            self._mcap.finish()  # type: ignore[no-untyped-call]
            self._partial_file.file.flush()
            self._partial_file.finish()
        return self._messages

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with suppress(OSError):
            self._partial_file.discard()

    @contextmanager
    def _disk_errors_explained(self) -> Iterator[None]:
        """Turn errors of the file system into one line with a remedy."""
        try:
            yield
        except OSError as error:
            raise TouchlineError(f"{self._path}: {error.strerror}; make room, or give another path") from None

    def _open_channel(self, channel: ChannelRecord) -> int:
        number = 0
        if channel.schema is not None:
            schema = channel.schema
            known = self._schemas.get((schema.name, schema.data))
            number = known or self._mcap.register_schema(schema.name, schema.encoding, schema.data)
            self._schemas[schema.name, schema.data] = number
        opened = self._mcap.register_channel(channel.key, channel.encoding, number, channel.metadata)
        self._channels[channel.key] = opened
        return opened
