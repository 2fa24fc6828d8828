"""Merges recordings of one match. Each message keeps its payload, times and sequence number."""

import heapq
from itertools import islice
from pathlib import Path

from recordings.container.key_selection import EVERYTHING
from recordings.container.manifest import Result
from recordings.editing.copy_writer import CopyWriter
from recordings.editing.message_copies import (
    CopySummary,
    MessageCopy,
    check_output,
    copy_manifest,
    message_copies,
)
from recordings.reading.recording import Recording
from schemas.errors import TouchlineError
from schemas.topics import APPLIED, WORLD


def merge_recordings(recordings: list[Recording], out: Path) -> CopySummary:
    """Write several recordings of one match into one, by log time; a message in several of them is written once.

    Raises:
        TouchlineError: they are of different matches, one is damaged inside, or the copy cannot be written.
    """
    check_output(out, recordings)
    _check_same_match(recordings)
    recordings = sorted(recordings, key=lambda recording: (recording.manifest.part, _begin(recording)))
    first = recordings[0]
    seen = _WrittenMessages(out)
    streams = [message_copies(recording, EVERYTHING, None) for recording in recordings]
    repeated = list(islice(streams[0], first.manifest.latched_count))
    dropped = 0
    with CopyWriter(out) as writer:
        is_drawn = any(recording.drawn for recording in recordings)
        manifest = copy_manifest(first.manifest, "merged", EVERYTHING)
        writer.begin(manifest, _all_attachments(recordings), len(repeated), viz=is_drawn)
        for entry in repeated:
            seen.is_new(entry)
            writer.add(entry, counted=False)
        for entry in heapq.merge(*streams, key=lambda entry: entry.log_ns):
            if seen.is_new(entry):
                writer.add(entry)
            else:
                dropped += 1
        return CopySummary(out, writer.finish(_last_result(recordings)), dropped)


class _WrittenMessages:
    """The messages already written, by key, sequence number and time of sending."""

    def __init__(self, out: Path) -> None:
        self._out = out
        self._written: dict[str, set[tuple[int, int]]] = {}
        self._of_host: dict[tuple[str, int], int] = {}

    def is_new(self, entry: MessageCopy) -> bool:
        """Whether a message has not been written before; it counts as written from then on.

        Raises:
            TouchlineError: the host sent different messages with one number, so these are different runs.
        """
        key, number, sent_ns = entry.channel.key, entry.sequence, entry.sent_ns
        written = self._written.setdefault(key, set())
        if (number, sent_ns) in written:
            return False
        written.add((number, sent_ns))
        if key in (WORLD.key, APPLIED.key) and self._of_host.setdefault((key, number), sent_ns) != sent_ns:
            raise TouchlineError(
                f"{self._out}: {key} number {number} is not the same in all files; "
                "these are recordings of different runs; merge recordings of one run"
            )
        return True


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
    """The result of the file with the newest message; None if its recorder did not finish it."""
    return max(recordings, key=_end).result


def _check_same_match(recordings: list[Recording]) -> None:
    def identity(recording: Recording) -> tuple[object, ...]:
        manifest = recording.manifest
        setup, config = manifest.setup, manifest.config
        return manifest.match, setup and (setup.teams, setup.profile, setup.rules), config and config.seed

    first = identity(recordings[0])
    for recording in recordings[1:]:
        for one, other in zip(first, identity(recording), strict=True):
            if one is not None and other is not None and one != other:
                raise TouchlineError(
                    f"{recording.path}: of another match than {recordings[0].path}; merge recordings of one match"
                )
