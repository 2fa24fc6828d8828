"""Copies a part of a recording. Each message keeps its payload, times and sequence number."""

from pathlib import Path

from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.container.manifest import Manifest
from recordings.editing.compose import composition
from recordings.reading.recording import Recording, nanoseconds
from recordings.recorder.latched_messages import LATCHED, LatchedMessages
from recordings.recorder.recording_writer import LoggedMessage
from recordings.recorder.roster_metadata import RosterMetadata
from schemas.errors import TouchlineError


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
    keys = [channel.key for channel in recording.channels if selection.includes(channel.key)]
    if not keys:
        raise TouchlineError(f"{recording.path}: none of its keys is selected; `touchline info` lists them")
    manifest = _manifest_of_copy(recording, selection, keys, start)
    roster = RosterMetadata(recording.manifest.setup, recording.lineup())
    with composition(out, manifest, recording.attachments, roster, viz=bool(recording.drawn)) as copy:
        for log_ns, received in _latched_at(recording, selection, start) if start is not None else ():
            copy.add(log_ns, received)
        latched = copy.messages
        for recorded in recording.messages(*keys, start=start, end=end):
            copy.add(recorded.log_ns, recorded.received())
        if copy.messages == latched:
            raise TouchlineError(
                f"{recording.path}: has no message of the selected keys and times; {_lasts(recording)}"
            )
        copy.finish(recording.result)
        return copy.messages


def _lasts(recording: Recording) -> str:
    begin = min(channel.start for channel in recording.channels)
    end = max(channel.end for channel in recording.channels)
    return f"it lasts from {begin:.2f} to {end:.2f} s of simulated time"


def _manifest_of_copy(recording: Recording, selection: KeySelection, keys: list[str], start: float | None) -> Manifest:
    """The manifest of a copy of these `keys`: part 1, whatever the original was.

    What two selections have in common is no key expression, so that its keys are named.
    """
    manifest = recording.manifest
    is_narrower = manifest.include and selection.include
    return manifest.replace(
        made="filtered",
        part=1,
        begins_ns=max(0, nanoseconds(start, manifest.begins_ns)),
        include=keys if is_narrower else [*manifest.include, *selection.include],
        exclude=[*manifest.exclude, *selection.exclude],
        damaged_records=recording.damaged_records,
    )


def _latched_at(recording: Recording, selection: KeySelection, start: float) -> list[LoggedMessage]:
    """The latched messages at a time."""
    latched = LatchedMessages()
    for recorded in recording.messages(end=start):
        if recorded.topic.key in LATCHED:
            latched.update((recorded.log_ns, recorded.received()))
    return [logged for logged in latched.messages() if selection.includes(logged[1].key)]
