"""Where a recorder's messages go: one file, or several in sequence."""

from collections.abc import Callable
from pathlib import Path

from recordings.container.manifest import EndReason, Manifest, Result
from recordings.container.numbering import check_free, numbered
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


class FileSink:
    """Writes one file, or several in sequence, each readable by itself.

    Any method may raise `TouchlineError` if the disk cannot be written.
    """

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

    def sync(self) -> None:
        """Flush to the disk soon."""
        self._writer.sync()

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
