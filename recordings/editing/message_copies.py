"""What filtering and merging have in common: messages to copy, the manifest of a copy, and its path."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from recordings.container.key_selection import KeySelection
from recordings.container.manifest import Manifest
from recordings.container.mcap_file import ChannelRecord, is_derived
from recordings.reading.recording import Recording
from schemas.errors import TouchlineError


class CopySummary(NamedTuple):
    """The result of a filter or merge."""

    path: Path
    messages: int
    dropped: int
    """Messages left out because another file has them, too."""


class MessageCopy(NamedTuple):
    """A message to be copied, with the channel of its original."""

    log_ns: int
    channel: ChannelRecord
    payload: bytes
    sent_ns: int
    sequence: int


def message_copies(recording: Recording, selection: KeySelection, end_ns: int | None) -> Iterator[MessageCopy]:
    """Yield the messages of a recording.

    The latched messages at its beginning are not filtered, as callers count them.
    """
    channels = {
        channel.key: channel for channel in recording.mcap_file.channels.values() if not is_derived(channel.metadata)
    }
    wanted = (
        {key for key in channels if selection.includes(key)} if not recording.manifest.latched_count else set(channels)
    )
    for key, message in recording.mcap_file.messages(wanted, None, end_ns):
        yield MessageCopy(message.log_time, channels[key], message.data, message.publish_time, message.sequence)


def copy_manifest(manifest: Manifest, how: str, selection: KeySelection) -> Manifest:
    """The manifest of a copy: part 1, whatever the original was."""
    return manifest.model_copy(
        update={
            "made": how,
            "part": 1,
            "include": [*manifest.include, *selection.include],
            "exclude": [*manifest.exclude, *selection.exclude],
        }
    )


def check_output(out: Path, recordings: list[Recording]) -> None:
    """Make sure that a copy does not overwrite one of its originals.

    Raises:
        TouchlineError: `out` is one of the recordings.
    """
    for recording in recordings:
        if out.exists() and recording.path.exists() and out.samefile(recording.path):
            raise TouchlineError(f"{out}: would overwrite the recording that is read; give another name for --out")
