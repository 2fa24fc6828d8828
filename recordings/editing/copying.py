"""Recordings made of recordings: a part of one, several in one. Every message keeps its bytes, times and number."""

import heapq
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.container.manifest import Manifest, Result
from recordings.container.mcap_file import ChannelRecord, is_derived
from recordings.editing.copy_writer import CopyWriter
from recordings.reading.recording import RecordedMessage, Recording
from recordings.recorder.latched_messages import LatchedMessages
from schemas.bus.contract import ReceivedMessage
from schemas.errors import TouchlineError
from schemas.topics import APPLIED, WORLD


class CopySummary(NamedTuple):
    """What was written."""

    path: Path
    messages: int
    dropped: int
    """Messages that more than one of the files had."""


class _Entry(NamedTuple):
    """A message on its way from one file to another."""

    log_ns: int
    channel: ChannelRecord
    payload: bytes
    sent_ns: int
    sequence: int


def filter_recording(
    recording: Recording,
    out: Path,
    selection: KeySelection = EVERYTHING,
    start: float | None = None,
    end: float | None = None,
) -> CopySummary:
    """Copy what is wanted of a recording, from `start` up to and without `end`, s of simulated time.

    A copy that begins later than the recording begins with what stood then.

    Raises:
        TouchlineError: the recording is damaged inside, or the copy cannot be written.
    """
    _check_other(out, [recording])
    start_ns, end_ns = _ns(start), _ns(end)
    entries = _entries(recording, selection, end_ns)
    latched: list[_Entry] = []
    rest: Iterator[_Entry] = iter(())
    if start_ns is None:
        repeated = [entry for _, entry in zip(range(recording.manifest.standing), entries, strict=False)]
        latched, rest = [entry for entry in repeated if selection.includes(entry.channel.key)], entries
    else:
        latched, rest = _latched_at(recording, selection, start_ns), _from(entries, start_ns)
    manifest = _copy_manifest(recording.manifest, "filtered", selection)
    with CopyWriter(out) as writer:
        writer.begin(manifest, recording.attachments, len(latched), viz=bool(recording.drawn))
        for entry in latched:
            writer.add(*_fields(entry), counted=False)
        for entry in rest:
            if selection.includes(entry.channel.key):
                writer.add(*_fields(entry))
        return CopySummary(out, writer.finish(recording.result), 0)


def merge_recordings(recordings: list[Recording], out: Path) -> CopySummary:
    """Write several recordings of one match into one, by log time; a message that several have is written once.

    Raises:
        TouchlineError: they are of different matches, one is damaged inside, or the copy cannot be written.
    """
    _check_other(out, recordings)
    _check_same_match(recordings)
    recordings = sorted(recordings, key=lambda recording: (recording.manifest.part, _begin(recording)))
    first = recordings[0]
    seen = _WrittenMessages(out)
    streams = [_entries(recording, EVERYTHING, None) for recording in recordings]
    repeated = [entry for _, entry in zip(range(first.manifest.standing), streams[0], strict=False)]
    dropped = 0
    with CopyWriter(out) as writer:
        is_drawn = any(recording.drawn for recording in recordings)
        manifest = _copy_manifest(first.manifest, "merged", EVERYTHING)
        writer.begin(manifest, _all_attachments(recordings), len(repeated), viz=is_drawn)
        for entry in repeated:
            seen.is_new(entry)
            writer.add(*_fields(entry), counted=False)
        for entry in heapq.merge(*streams, key=lambda entry: entry.log_ns):
            if seen.is_new(entry):
                writer.add(*_fields(entry))
            else:
                dropped += 1
        return CopySummary(out, writer.finish(_last_result(recordings)), dropped)


class _WrittenMessages:
    """Which messages were written already, by key, number and time of sending."""

    def __init__(self, out: Path) -> None:
        self._out = out
        self._written: dict[str, set[tuple[int, int]]] = {}
        self._of_host: dict[tuple[str, int], int] = {}

    def is_new(self, entry: _Entry) -> bool:
        """Whether the message was not written before.

        Raises:
            TouchlineError: the host said two things under one number: these are two matches.
        """
        key, number, sent_ns = entry.channel.key, entry.sequence, entry.sent_ns
        written = self._written.setdefault(key, set())
        if (number, sent_ns) in written:
            return False
        written.add((number, sent_ns))
        if key in (WORLD.key, APPLIED.key) and self._of_host.setdefault((key, number), sent_ns) != sent_ns:
            raise TouchlineError(
                f"{self._out}: {key} number {number} is not the same in all files; "
                "these are recordings of different runs, merge those of one"
            )
        return True


def _entries(recording: Recording, selection: KeySelection, end_ns: int | None) -> Iterator[_Entry]:
    """The messages of a recording; those that stand at its beginning all the same, as somebody counts them."""
    channels = {
        channel.key: channel for channel in recording.mcap_file.channels.values() if not is_derived(channel.metadata)
    }
    wanted = {key for key in channels if selection.includes(key)} if not recording.manifest.standing else set(channels)
    for key, message in recording.mcap_file.messages(wanted, None, end_ns):
        yield _Entry(message.log_time, channels[key], message.data, message.publish_time, message.sequence)


def _from(entries: Iterable[_Entry], start_ns: int) -> Iterator[_Entry]:
    return (entry for entry in entries if entry.log_ns >= start_ns)


def _latched_at(recording: Recording, selection: KeySelection, start_ns: int) -> list[_Entry]:
    """What stood at a moment."""
    latched = LatchedMessages()
    latched.update((recorded.log_ns, _as_recorded(recorded)) for recorded in recording.messages(end=start_ns / 1e9))
    channels = {channel.key: channel for channel in recording.mcap_file.channels.values()}
    entries = []
    for log_ns, received in latched.messages():
        if selection.includes(received.key) and received.stamp is not None:
            stamp = received.stamp
            entries.append(_Entry(log_ns, channels[received.key], received.payload, stamp.sent_ns, stamp.sequence))
    return entries


def _as_recorded(recorded: RecordedMessage) -> ReceivedMessage:
    """The message with its own bytes, whatever version they are of."""
    return ReceivedMessage(recorded.topic, recorded.key, recorded.payload, recorded.stamp)


def _fields(entry: _Entry) -> tuple[ChannelRecord, int, bytes, int, int]:
    return entry.channel, entry.log_ns, entry.payload, entry.sent_ns, entry.sequence


def _copy_manifest(manifest: Manifest, how: str, selection: KeySelection) -> Manifest:
    """The manifest of a copy: part 1, whatever the original was."""
    return manifest.model_copy(
        update={
            "made": how,
            "part": 1,
            "include": [*manifest.include, *selection.include],
            "exclude": [*manifest.exclude, *selection.exclude],
        }
    )


def _end(recording: Recording) -> float:
    return max((channel.end for channel in recording.channels), default=0.0)


def _begin(recording: Recording) -> float:
    return min((channel.start for channel in recording.channels), default=0.0)


def _all_attachments(recordings: list[Recording]) -> dict[str, bytes]:
    every: dict[str, bytes] = {}
    for recording in recordings:
        every = {**recording.attachments, **every}
    return every


def _last_result(recordings: list[Recording]) -> Result | None:
    """The result of the file that goes on longest; nothing where its recorder did not finish it."""
    return max(
        recordings, key=lambda recording: max((channel.end for channel in recording.channels), default=0.0)
    ).result


def _check_same_match(recordings: list[Recording]) -> None:
    def said(recording: Recording) -> tuple[object, ...]:
        manifest = recording.manifest
        setup, config = manifest.setup, manifest.config
        return manifest.match, setup and (setup.teams, setup.profile, setup.rules), config and config.seed

    first = said(recordings[0])
    for recording in recordings[1:]:
        for one, other in zip(first, said(recording), strict=True):
            if one is not None and other is not None and one != other:
                raise TouchlineError(
                    f"{recording.path}: of another match than {recordings[0].path}; merge recordings of one match"
                )


def _check_other(out: Path, recordings: list[Recording]) -> None:
    for recording in recordings:
        if out.exists() and recording.path.exists() and out.samefile(recording.path):
            raise TouchlineError(f"{out}: would be written over what is read; give another name for --out")


def _ns(seconds: float | None) -> int | None:
    return round(seconds * 1e9) if seconds is not None else None
