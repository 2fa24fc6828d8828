"""Copies a part of a recording. Each message keeps its payload, times and sequence number."""

from collections.abc import Iterator
from pathlib import Path

from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.container.manifest import Manifest
from recordings.container.mcap_file import is_derived
from recordings.editing.copy_writer import CopyWriter, MessageCopy
from recordings.reading.recording import RecordedMessage, Recording
from recordings.recorder.latched_messages import LatchedMessages
from schemas.bus.contract import ReceivedMessage
from schemas.errors import TouchlineError
from schemas.process.whole_file import written_whole


def filter_recording(
    recording: Recording,
    out: Path,
    selection: KeySelection = EVERYTHING,
    start: float | None = None,
    end: float | None = None,
) -> int:
    """Copy the selected keys of a recording, from `start` up to but not including `end`, in s of simulated time.

    Returns the number of messages in the copy.

    A copy that begins later than the recording begins with the latched messages of that time.

    Raises:
        TouchlineError: no message is selected, the recording is damaged inside, or the copy cannot be written.
    """
    if out.exists() and recording.path.exists() and out.samefile(recording.path):
        raise TouchlineError(f"{out}: would overwrite the recording that is read; give another name for --out")
    if not any(selection.includes(channel.key) for channel in recording.channels):
        raise TouchlineError(f"{recording.path}: none of its keys is selected; `touchline info` lists them")
    manifest = _manifest_of_copy(recording.manifest, selection, _ns(start))
    try:
        with written_whole(out) as draft, draft.open("wb") as file:
            writer = CopyWriter(file)
            writer.begin(manifest, recording.attachments, viz=bool(recording.drawn))
            for entry in _latched_at(recording, selection, start) if start is not None else ():
                writer.add(entry)
            latched = writer.messages
            for entry in _copies(recording, selection, _ns(start), _ns(end)):
                writer.add(entry)
            if writer.messages == latched:
                raise TouchlineError(
                    f"{recording.path}: has no message of the selected keys and times; {_lasts(recording)}"
                )
            writer.finish(recording.result)
            return writer.messages
    except OSError as error:
        raise TouchlineError(f"{out}: {error.strerror}; make room, or give another path") from None


def _lasts(recording: Recording) -> str:
    begin = min(channel.start for channel in recording.channels)
    end = max(channel.end for channel in recording.channels)
    return f"it lasts from {begin:.2f} to {end:.2f} s of simulated time"


def _copies(
    recording: Recording, selection: KeySelection, start_ns: int | None, end_ns: int | None
) -> Iterator[MessageCopy]:
    channels = {
        channel.key: channel
        for channel in recording.mcap_file.channels.values()
        if not is_derived(channel.metadata) and selection.includes(channel.key)
    }
    for key, message in recording.mcap_file.messages({*channels}, start_ns, end_ns):
        yield MessageCopy(message.log_time, channels[key], message.data, message.publish_time, message.sequence)


def _manifest_of_copy(manifest: Manifest, selection: KeySelection, start_ns: int | None) -> Manifest:
    """The manifest of a copy: part 1, whatever the original was."""
    return manifest.replace(
        made="filtered",
        part=1,
        begins_ns=manifest.begins_ns if start_ns is None else max(0, start_ns),
        include=[*manifest.include, *selection.include],
        exclude=[*manifest.exclude, *selection.exclude],
    )


def _latched_at(recording: Recording, selection: KeySelection, start: float) -> list[MessageCopy]:
    """The latched messages at a time, as copies."""
    latched = LatchedMessages()
    latched.update((recorded.log_ns, _as_recorded(recorded)) for recorded in recording.messages(end=start))
    channels = {channel.key: channel for channel in recording.mcap_file.channels.values()}
    entries = []
    for log_ns, received in latched.messages():
        if selection.includes(received.key) and received.stamp is not None:
            stamp = received.stamp
            entries.append(MessageCopy(log_ns, channels[received.key], received.payload, stamp.sent_ns, stamp.sequence))
    return entries


def _ns(seconds: float | None) -> int | None:
    return round(seconds * 1e9) if seconds is not None else None


def _as_recorded(recorded: RecordedMessage) -> ReceivedMessage:
    """The message with its recorded bytes, whatever version of the protocol they are of."""
    return ReceivedMessage(recorded.topic, recorded.key, recorded.payload, recorded.stamp)
