"""Where a recorder's messages go: what every output does, and one file or several that follow each other."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from recordings.account import Account
from recordings.cast import Cast
from recordings.manifest import Ended, Manifest, Result
from recordings.numbering import check_free, drop_oldest, numbered
from recordings.standing import Logged, Standing
from recordings.writer import RecordingWriter
from schemas.clock import Clock
from schemas.errors import TouchlineError

Head = Callable[[], tuple[Manifest, dict[str, bytes]]]
"""Makes the manifest and the attachments of a file that begins now."""
Tail = Callable[[Ended], Result]
"""Makes the result of a file that ends now."""


@dataclass(frozen=True, slots=True)
class Limits:
    """When a file is finished and the next one begun, and how much is kept."""

    size: int | None = None
    """Bytes of a file."""
    duration: float | None = None
    """Simulated s in a file."""
    keep: int | None = None
    """Finished files that are kept, the newest; all where nothing is said."""
    snapshot: float | None = None
    """Simulated s that are held in memory and written when there is a goal, or on request; nothing else is."""

    def __post_init__(self) -> None:
        """Check that the limits go together."""
        if self.keep is not None and not self.in_many:
            raise TouchlineError(
                f"--keep {self.keep} is for many files; add --split-size, --split-duration or --snapshot"
            )
        if self.snapshot is not None and (self.size is not None or self.duration is not None):
            raise TouchlineError("--snapshot writes files of its own; leave --split-size and --split-duration out")

    @property
    def in_many(self) -> bool:
        """Several files may come of it."""
        return any(limit is not None for limit in (self.size, self.duration, self.snapshot))


ONE_FILE = Limits()


class Output(Protocol):
    """Takes messages in their order. Any method may raise `TouchlineError` when the disk refuses."""

    files: list[Path]
    """Finished and kept, the oldest first."""

    @property
    def path(self) -> Path:
        """Where it writes, or, with snapshots, wrote last."""

    def begin(self, head: Head, tail: Tail, cast: Cast) -> None:
        """The match is known."""

    def write(self, batch: list[Logged]) -> None:
        """Messages in the order they shall stand in."""

    def pass_over(self, batch: list[Logged]) -> None:
        """Messages that came while the recorder was paused; what stands after them is written when it goes on."""

    def sync(self) -> None:
        """Have all of it on the disk soon."""

    def split(self) -> str:
        """Go on in another file; why not, or nothing."""

    def snapshot(self, why: str) -> str:
        """Write what is held in memory; why not, or nothing."""

    def finish(self, ended: Ended) -> int:
        """Finish; returns the bytes in all files that are kept."""

    def abandon(self) -> None:
        """Leave a file that is not finished as it is."""


class Files:
    """One file, or several, each whole in itself."""

    def __init__(
        self, path: Path, clock: Clock, match: str, account: Account, limits: Limits = ONE_FILE, *, viz: bool = True
    ) -> None:
        """Opens the first file; with `viz`, what viewers draw is written, too.

        Raises:
            TouchlineError: it cannot be written.
        """
        self._viz = viz
        self._base, self._clock, self._match, self._account, self._limits = path, clock, match, account, limits
        self._part = 1
        self._many = limits.in_many
        if self._many:
            check_free(path)
        self.files: list[Path] = []
        self._cast = Cast()
        self._writer = self._open()
        self._standing = Standing()
        self._first_ns: int | None = None
        self._last_ns = -1
        self._passed_over_ns: int | None = None

    @property
    def path(self) -> Path:
        """The file that is being written, by the name it will have."""
        return self._writer.path

    def begin(self, head: Head, tail: Tail, cast: Cast) -> None:
        """Write the head of the first file."""
        self._head, self._tail = head, tail
        self._writer.know(cast)
        self._cast = cast
        self._begin_file([])

    def write(self, batch: list[Logged]) -> None:
        """Write, in as many files as the limits ask for."""
        if self._passed_over_ns is not None:
            self._writer.write(self._standing.messages(since_ns=self._passed_over_ns))
            self._passed_over_ns = None
        begin = 0
        if self._many:
            for index, (log_ns, _) in enumerate(batch):
                if self._is_full(log_ns):
                    self._hand_on(batch[begin:index])
                    begin = index
                    self._next(Ended.SPLIT)
                if self._first_ns is None:
                    self._first_ns = log_ns
                self._last_ns = log_ns
        self._hand_on(batch[begin:])

    def pass_over(self, batch: list[Logged]) -> None:
        """Follow what stands."""
        if batch and self._passed_over_ns is None:
            self._passed_over_ns = batch[0][0]
        self._account.enter(batch, left_out=True)
        self._standing.take(batch)

    def sync(self) -> None:
        """Have all of it on the disk soon."""
        self._writer.sync()

    def split(self) -> str:
        """Go on in another file."""
        if not self._many:
            return "it writes one file; start it with --split-size or --split-duration"
        if self._first_ns is None:
            return "its file is empty still"
        self._next(Ended.SPLIT)
        return ""

    def snapshot(self, why: str) -> str:
        """Everything is written anyway."""
        del why
        return "it records all the time; start it with --snapshot SECONDS"

    def finish(self, ended: Ended) -> int:
        """Finish the last file."""
        self._finish_file(ended)
        return sum(file.stat().st_size for file in self.files)

    def abandon(self) -> None:
        """Leave the last file as it is."""
        self._writer.abandon()

    def _open(self) -> RecordingWriter:
        path = numbered(self._base, self._part) if self._many else self._base
        return RecordingWriter(path, self._clock, self._match, self._cast, viz=self._viz)

    def _begin_file(self, standing: list[Logged]) -> None:
        manifest, attachments = self._head()
        self._writer.begin(manifest.model_copy(update={"part": self._part}), attachments, standing)
        self._first_ns = None

    def _hand_on(self, batch: list[Logged]) -> None:
        if batch:
            self._account.enter(batch)
            self._standing.take(batch)
            self._writer.write(batch)

    def _is_full(self, log_ns: int) -> bool:
        """Whether a message of this log time belongs into the next file; those of one tick stay together."""
        if self._first_ns is None or log_ns == self._last_ns:
            return False
        limits = self._limits
        if limits.duration is not None and log_ns - self._first_ns >= round(limits.duration * 1e9):
            return True
        return limits.size is not None and self._writer.size >= limits.size

    def _next(self, ended: Ended) -> None:
        self._finish_file(ended)
        self._part += 1
        self._writer = self._open()
        self._begin_file(self._standing.messages())

    def _finish_file(self, ended: Ended) -> None:
        self._writer.finish(self._tail(ended))
        self.files.append(self._writer.path)
        self._account.next_file()
        drop_oldest(self.files, self._limits.keep)
