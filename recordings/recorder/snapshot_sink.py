"""A sink that keeps the last seconds in memory, and writes them to a file at each goal or request."""

from collections import deque
from pathlib import Path

from recordings.container.manifest import EndReason, Result
from recordings.container.numbering import check_free, drop_oldest, numbered
from recordings.recorder.file_limits import FileLimits
from recordings.recorder.latched_messages import LatchedMessages, LoggedMessage
from recordings.recorder.leftover import Leftover
from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.recording_writer import RecordingWriter
from recordings.recorder.roster_metadata import RosterMetadata
from recordings.recorder.sink import MakeHeader, MakeResult
from schemas.game import EventKind
from schemas.messages.game import GameEvent
from schemas.process.clock import Clock
from schemas.topics import EVENT
from schemas.wire.message import BadMessageError


class SnapshotSink:
    """Keeps the last seconds in memory, and writes them to a new file at a goal, or on request."""

    def __init__(
        self,
        path: Path,
        clock: Clock,
        match: str,
        loss_counts: LossCounts,
        limits: FileLimits,
        *,
        viz: bool = True,
        leftover: Leftover | None = None,
    ) -> None:
        """Locks the name of the next snapshot against other recorders.

        With `viz`, the channels for viewers are written, too. With a `leftover`, the snapshots of a killed recorder
        are continued: goals that it has written are not written again.

        Raises:
            TouchlineError: another recorder has locked it, or the file cannot be written.
        """
        self._viz = viz
        assert limits.snapshot is not None
        self._base, self._clock, self._match, self._loss_counts, self._keep = (
            path,
            clock,
            match,
            loss_counts,
            limits.keep,
        )
        self._horizon_ns = round(limits.snapshot * 1e9)
        self._held: deque[LoggedMessage] = deque()
        self._latched_before = LatchedMessages()
        """The latched messages before the oldest one in memory."""
        self._number = 0
        self._written_to_ns = -1
        self.files: list[Path] = []
        if leftover is None:
            check_free(path)
        else:
            self._number, self.files, self._written_to_ns = leftover.part, leftover.files, leftover.last_ns
            if leftover.partial_file is not None:
                leftover.partial_file.discard()  # its messages come from the host again, and so does its goal
                self._number -= 1
        self._roster = RosterMetadata()
        self._next = self._open()

    @property
    def path(self) -> Path:
        """The newest snapshot, or the name of the first one."""
        return self.files[-1] if self.files else numbered(self._base, 1)

    def begin(self, make_header: MakeHeader, make_result: MakeResult, roster: RosterMetadata) -> None:
        """Keep the functions that make manifests and results."""
        self._make_header, self._make_result, self._roster = make_header, make_result, roster
        self._next.set_roster(roster)

    def write(self, batch: list[LoggedMessage]) -> None:
        """Keep messages, drop those that are too old, and write all of them after a goal."""
        self._loss_counts.add(batch)
        self._held.extend(batch)
        if batch:
            self._drop_older(batch[-1][0] - self._horizon_ns)
        if any(_is_goal(logged) for logged in batch if logged[0] > self._written_to_ns):
            self.snapshot("goal")

    def skip(self, batch: list[LoggedMessage]) -> None:
        """Follow the latched messages. A pause is a gap, so the messages before it are dropped."""
        self._loss_counts.add(batch, left_out=True)
        self._drop_older(None)
        self._latched_before.update(batch)

    def sync(self) -> None:
        """Has no effect: finished snapshots are on the disk."""

    def split(self) -> str:
        """Not supported: there is no file to continue."""
        return "it writes snapshots; request one instead"

    def snapshot(self, why: str) -> str:
        """Write the messages in memory."""
        if not self._held:
            return "it has no messages yet"
        writer = self._next
        self._number += 1
        manifest, attachments = self._make_header()
        made = {"part": self._number, "made": f"snapshot: {why}"}
        try:
            writer.begin(manifest.model_copy(update=made), attachments, self._latched_before.messages())
            writer.write(list(self._held))
            writer.finish(self._result())
        finally:
            writer.abandon()
        self.files.append(writer.path)
        self._next = self._open()
        drop_oldest(self.files, self._keep)
        return ""

    def finish(self, ended: EndReason) -> int:
        """Drop the messages in memory."""
        del ended
        self._next.discard()
        return sum(file.stat().st_size for file in self.files)

    def abandon(self) -> None:
        """Unlock the name of the next snapshot."""
        if not self._next.begun:
            self._next.discard()

    def _open(self) -> RecordingWriter:
        return RecordingWriter(
            numbered(self._base, self._number + 1), self._clock, self._match, self._roster, viz=self._viz
        )

    def _drop_older(self, before_ns: int | None) -> None:
        while self._held and (before_ns is None or self._held[0][0] < before_ns):
            self._latched_before.update([self._held.popleft()])

    def _result(self) -> Result:
        """The result with the counts of these seconds alone."""
        loss_counts = LossCounts()
        loss_counts.add(self._held)
        counts = {
            key: count.model_copy(update={"missed_before_start": 0})
            for key, count in loss_counts.for_this_file().items()
        }
        return self._make_result(EndReason.SNAPSHOT).counted(counts)


def _is_goal(logged: LoggedMessage) -> bool:
    received = logged[1]
    if received.key != EVENT.key:
        return False
    try:
        event: GameEvent = received.message()
    except BadMessageError:
        return False
    return event.kind is EventKind.GOAL
