"""Sinks for a recorder's messages: the protocol, and a sink that writes one file or several in sequence."""

from collections.abc import Callable
from pathlib import Path
from typing import Protocol

from recordings.container.manifest import EndReason, Manifest, Result
from recordings.container.numbering import check_free, drop_oldest, numbered
from recordings.recorder.file_limits import ONE_FILE, FileLimits
from recordings.recorder.latched_messages import LatchedMessages, LoggedMessage
from recordings.recorder.leftover import Leftover
from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.recording_writer import RecordingWriter
from recordings.recorder.roster_metadata import RosterMetadata
from schemas.process.clock import Clock

MakeHeader = Callable[[], tuple[Manifest, dict[str, bytes]]]
"""Makes the manifest and the attachments of a file that begins now."""
MakeResult = Callable[[EndReason], Result]
"""Makes the result of a file that ends now."""


class Sink(Protocol):
    """Writes messages in order. Any method may raise `TouchlineError` if the disk cannot be written."""

    files: list[Path]
    """Finished files that are kept, the oldest first."""

    @property
    def path(self) -> Path:
        """The file that is being written, or the newest snapshot."""

    def begin(self, make_header: MakeHeader, make_result: MakeResult, roster: RosterMetadata) -> None:
        """Begin to write, when the setup of the match is known."""

    def write(self, batch: list[LoggedMessage]) -> None:
        """Write messages in the order of the file."""

    def skip(self, batch: list[LoggedMessage]) -> None:
        """Skip messages received during a pause; changed latched messages are written when recording resumes."""

    def sync(self) -> None:
        """Flush to the disk soon."""

    def split(self) -> str:
        """Continue in another file; returns why that is impossible, or an empty string."""

    def snapshot(self, why: str) -> str:
        """Write the messages in memory; returns why that is impossible, or an empty string."""

    def finish(self, ended: EndReason) -> int:
        """Finish; returns the size of all files that are kept, in bytes."""

    def abandon(self) -> None:
        """Close an unfinished file as it is."""


class FileSink:
    """Writes one file, or several in sequence, each readable by itself."""

    def __init__(
        self,
        path: Path,
        clock: Clock,
        match: str,
        loss_counts: LossCounts,
        limits: FileLimits = ONE_FILE,
        *,
        viz: bool = True,
        leftover: Leftover | None = None,
    ) -> None:
        """Opens the first file; with `viz`, the channels for viewers are written, too.

        With a `leftover`, the recording of a killed recorder is continued.

        Raises:
            TouchlineError: the file cannot be written.
        """
        self._viz = viz
        self._base, self._clock, self._match, self._loss_counts, self._limits = path, clock, match, loss_counts, limits
        self._part = 1
        self._is_split = limits.is_split
        self._latched = LatchedMessages()
        self._first_ns: int | None = None
        self._last_ns = -1
        self.files: list[Path] = []
        if leftover is not None:
            self._part = leftover.part if leftover.partial_file is not None else leftover.part + 1
            self._latched, self.files = leftover.latched, leftover.files
            self._first_ns = leftover.first_ns if leftover.partial_file is not None else None
            self._last_ns = leftover.last_ns
        elif self._is_split:
            check_free(path)
        self._continued = leftover
        self._roster = RosterMetadata()
        self._writer = self._open(leftover)
        self._skipped_since_ns: int | None = None

    @property
    def path(self) -> Path:
        """Final name of the file that is being written."""
        return self._writer.path

    def begin(self, make_header: MakeHeader, make_result: MakeResult, roster: RosterMetadata) -> None:
        """Write the header of the first file."""
        self._make_header, self._make_result = make_header, make_result
        self._writer.set_roster(roster)
        self._roster = roster
        first_ns = self._first_ns
        is_next = self._continued is not None and self._continued.partial_file is None
        self._begin_file(self._latched.messages() if is_next else [])
        self._first_ns = first_ns

    def write(self, batch: list[LoggedMessage]) -> None:
        """Write messages, and begin new files at the limits."""
        if self._skipped_since_ns is not None:
            self._writer.write(self._latched.messages(since_ns=self._skipped_since_ns))
            self._skipped_since_ns = None
        begin = 0
        if self._is_split:
            for index, (log_ns, _) in enumerate(batch):
                if self._is_full(log_ns):
                    self._write_batch(batch[begin:index])
                    begin = index
                    self._next(EndReason.SPLIT)
                if self._first_ns is None:
                    self._first_ns = log_ns
                self._last_ns = log_ns
        self._write_batch(batch[begin:])

    def skip(self, batch: list[LoggedMessage]) -> None:
        """Follow the latched messages without writing."""
        if batch and self._skipped_since_ns is None:
            self._skipped_since_ns = batch[0][0]
        self._loss_counts.add(batch, left_out=True)
        self._latched.update(batch)

    def sync(self) -> None:
        """Flush to the disk soon."""
        self._writer.sync()

    def split(self) -> str:
        """Continue in another file."""
        if not self._is_split:
            return "it writes one file; start it with --split-size or --split-duration"
        if self._first_ns is None:
            return "its file is still empty"
        self._next(EndReason.SPLIT)
        return ""

    def snapshot(self, why: str) -> str:
        """Not supported: all messages are written in any case."""
        del why
        return "it records all the time; start it with --snapshot SECONDS"

    def finish(self, ended: EndReason) -> int:
        """Finish the last file."""
        self._finish_file(ended)
        return sum(file.stat().st_size for file in self.files)

    def abandon(self) -> None:
        """Close the last file as it is."""
        self._writer.abandon()

    def _open(self, leftover: Leftover | None = None) -> RecordingWriter:
        path = numbered(self._base, self._part) if self._is_split else self._base
        return RecordingWriter(path, self._clock, self._match, self._roster, viz=self._viz, leftover=leftover)

    def _begin_file(self, latched: list[LoggedMessage]) -> None:
        manifest, attachments = self._make_header()
        self._writer.begin(manifest.model_copy(update={"part": self._part}), attachments, latched)
        self._first_ns = None

    def _write_batch(self, batch: list[LoggedMessage]) -> None:
        if batch:
            self._loss_counts.add(batch)
            self._latched.update(batch)
            self._writer.write(batch)

    def _is_full(self, log_ns: int) -> bool:
        """Whether a message with this log time begins the next file; messages of one tick stay together."""
        if self._first_ns is None or log_ns == self._last_ns:
            return False
        limits = self._limits
        if limits.duration is not None and log_ns - self._first_ns >= round(limits.duration * 1e9):
            return True
        return limits.size is not None and self._writer.size >= limits.size

    def _next(self, ended: EndReason) -> None:
        self._finish_file(ended)
        self._part += 1
        self._writer = self._open()
        self._begin_file(self._latched.messages())

    def _finish_file(self, ended: EndReason) -> None:
        self._writer.finish(self._make_result(ended))
        self.files.append(self._writer.path)
        self._loss_counts.start_file()
        drop_oldest(self.files, self._limits.keep)
