"""Where a recorder's messages go: into a part of its recording, and at its limits into the next one."""

from collections.abc import Callable
from pathlib import Path

from recordings.container.manifest import EndReason, Manifest, Result
from recordings.container.parts import part_path
from recordings.recorder.earlier_parts import EarlierParts
from recordings.recorder.latched_messages import LATCHED, LatchedMessages
from recordings.recorder.recording_writer import LoggedMessage, RecordingWriter
from recordings.recorder.roster_metadata import RosterMetadata
from recordings.recorder.sequence_tracker import LossCounts
from runtime.process.clock import Clock
from schemas.config.settings import RecordOptions

MakeHeader = Callable[[], tuple[Manifest, dict[str, bytes]]]
"""Makes the manifest and the attachments of a part that begins now."""
MakeResult = Callable[[EndReason], Result]
"""Makes the result of a part that ends now."""
_NO_LIMITS = RecordOptions()
_MB = 1e6


class PartSink:
    """Writes one part, or several in sequence, each readable by itself.

    Any method may raise `TouchlineError` if the disk cannot be written.
    """

    def __init__(
        self,
        path: Path,
        clock: Clock,
        options: RecordOptions = _NO_LIMITS,
        earlier: EarlierParts | None = None,
    ) -> None:
        """Creates the first part that is not there yet, after the `earlier` ones.

        Raises:
            TouchlineError: the file cannot be created.
        """
        self._path, self._clock, self._options = path, clock, options
        before = earlier or EarlierParts()
        self.loss_counts: LossCounts = before.loss_counts
        self._latched: LatchedMessages = before.latched
        self._begins_ns = before.begins_ns
        self._first_ns: int | None = None
        """Simulated time of the first message of this part, in ns."""
        self._last_ns = -1
        self.files = [*before.files]
        """The parts, the last of which is being written."""
        self._roster = RosterMetadata()
        self._writer = self._open()

    def begin(self, make_header: MakeHeader, make_result: MakeResult, roster: RosterMetadata) -> None:
        """Write the header of the first part."""
        self._make_header, self._make_result, self._roster = make_header, make_result, roster
        self._begin_part()

    def write(self, batch: list[LoggedMessage]) -> None:
        """Write messages in order, and begin new parts at the limits."""
        begin = 0
        for index, (log_ns, _) in enumerate(batch):
            if self._is_full(log_ns):
                self._write_batch(batch[begin:index])
                begin = index
                self._finish_part(EndReason.CONTINUED)
                self._begins_ns, self._first_ns = log_ns, None
                self._writer = self._open()
                self._begin_part()
            if self._first_ns is None:
                self._first_ns = log_ns
            self._last_ns = log_ns
        self._write_batch(batch[begin:])

    def sync(self) -> None:
        """Flush to the disk soon."""
        self._writer.sync()

    def finish(self, ended: EndReason) -> int:
        """Finish the last part; returns the size of all parts, in bytes."""
        self._finish_part(ended)
        return sum(file.stat().st_size for file in self.files)

    def abandon(self) -> None:
        """Close the last part as it is, or remove it if nothing was written."""
        self._writer.abandon()

    def _open(self) -> RecordingWriter:
        path = part_path(self._path, len(self.files) + 1)
        writer = RecordingWriter(path, self._clock, viz=self._options.viz)
        self.files.append(path)
        return writer

    def _begin_part(self) -> None:
        manifest, attachments = self._make_header()
        place = {"part": len(self.files), "begins_ns": self._begins_ns}
        self._writer.begin(manifest.replace(**place), attachments, self._roster)
        self._writer.write(self._latched.messages())

    def _write_batch(self, batch: list[LoggedMessage]) -> None:
        if batch:
            self.loss_counts.add(received for _, received in batch)
            for logged in batch:
                if logged[1].topic.key in LATCHED:
                    self._latched.update(logged)
            self._writer.write(batch)

    def _is_full(self, log_ns: int) -> bool:
        """Whether a message with this log time begins the next part; messages of one tick stay together."""
        if self._first_ns is None or log_ns == self._last_ns:
            return False
        size, duration = self._options.part_size, self._options.part_duration
        if duration is not None and log_ns - self._first_ns >= round(duration * 1e9):
            return True
        return size is not None and self._writer.size >= size * _MB

    def _finish_part(self, ended: EndReason) -> None:
        self._writer.finish(self._make_result(ended))
