"""Writes a recording from the unchanged messages of another recording."""

from pathlib import Path
from typing import IO, NamedTuple

from recordings.container.attachments import MEDIA_TYPES
from recordings.container.environment import library
from recordings.container.manifest import MANIFEST, RESULT, Manifest, Result
from recordings.container.mcap_file import ChannelRecord
from recordings.container.mcap_writer import mcap_writer
from recordings.container.sealed_metadata import digest, to_metadata
from recordings.recorder.sequence_tracker import SequenceTracker
from recordings.viz.viz_channels import VizChannels
from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.topics import TOPICS


class MessageCopy(NamedTuple):
    """A message to be copied, with the channel of its original."""

    log_ns: int
    channel: ChannelRecord
    payload: bytes
    sent_ns: int
    sequence: int


class CopyWriter:
    """Writes one file. Its methods may raise `OSError`."""

    def __init__(self, file: IO[bytes]) -> None:
        self._mcap = mcap_writer(file)
        self._channels: dict[str, int] = {}
        self._schemas: dict[tuple[str, bytes], int] = {}
        self._trackers: dict[str, SequenceTracker] = {}
        self._begins_ns = 0
        self.messages = 0
        """Messages so far."""
        self._viz_channels: VizChannels | None = None

    def begin(self, manifest: Manifest, attachments: dict[str, bytes], *, viz: bool) -> None:
        """Write manifest and attachments. With `viz`, the channels for viewers are written, too."""
        if viz and manifest.setup is not None:
            self._viz_channels = VizChannels(self._mcap, manifest.setup)
        self._begins_ns = manifest.begins_ns
        attached = {name: digest(content) for name, content in attachments.items()}
        metadata = to_metadata(manifest.replace(attached=attached))
        self._mcap.start(profile="", library=library())
        self._mcap.add_metadata(MANIFEST, metadata)
        for name, data in attachments.items():
            self._mcap.add_attachment(0, 0, name, MEDIA_TYPES.get(Path(name).suffix, "application/octet-stream"), data)
        self._mcap.add_metadata(MANIFEST, metadata)  # again, as in every recording

    def add(self, copy: MessageCopy) -> None:
        """Write a message; one from before the beginning of the copy is not in its counts."""
        channel, stamp = copy.channel, Stamp(copy.sequence, copy.sent_ns, copy.log_ns)
        number = self._channels.get(channel.key) or self._open_channel(channel)
        self._mcap.add_message(number, copy.log_ns, copy.payload, copy.sent_ns, copy.sequence)
        topic = TOPICS.get(channel.metadata.get("topic", ""))
        if self._viz_channels is not None and topic is not None:
            self._viz_channels.draw(ReceivedMessage(topic, channel.key, copy.payload, stamp), copy.log_ns)
        self.messages += 1
        if copy.log_ns >= self._begins_ns:
            self._trackers.setdefault(channel.key, SequenceTracker()).add(stamp, len(copy.payload))

    def finish(self, result: Result | None) -> None:
        """Write the result with the counts of this file."""
        self._mcap.flush()  # type: ignore[no-untyped-call]
        if result is not None:
            counts = {key: tracker.count() for key, tracker in sorted(self._trackers.items())}
            self._mcap.add_metadata(RESULT, to_metadata(result.counted(counts)))
        self._mcap.finish()  # type: ignore[no-untyped-call]

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
