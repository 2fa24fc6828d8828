"""Messages on their way from recordings into a copy, and what every copy needs: a manifest and a path of its own."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from recordings.container.key_selection import KeySelection
from recordings.container.manifest import Manifest
from recordings.container.mcap_file import ChannelRecord, is_derived
from recordings.reading.recording import Recording
from schemas.errors import TouchlineError


class CopySummary(NamedTuple):
    """What was written."""

    path: Path
    messages: int
    dropped: int
    """Messages that more than one of the files had."""


class MessageCopy(NamedTuple):
    """A message on its way from one file to another."""

    log_ns: int
    channel: ChannelRecord
    payload: bytes
    sent_ns: int
    sequence: int


def message_copies(recording: Recording, selection: KeySelection, end_ns: int | None) -> Iterator[MessageCopy]:
    """The messages of a recording; those that stand at its beginning all the same, as somebody counts them."""
    channels = {
        channel.key: channel for channel in recording.mcap_file.channels.values() if not is_derived(channel.metadata)
    }
    wanted = {key for key in channels if selection.includes(key)} if not recording.manifest.standing else set(channels)
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
    for recording in recordings:
        if out.exists() and recording.path.exists() and out.samefile(recording.path):
            raise TouchlineError(f"{out}: would be written over what is read; give another name for --out")
