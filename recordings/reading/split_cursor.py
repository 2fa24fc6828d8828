"""One cursor over the files of a split recording, from the first or any other of them to the last.

The latched messages that a file repeats at its beginning are skipped if the file before it was played.
"""

import re
from collections.abc import Callable
from pathlib import Path

from recordings.container.manifest import EndReason
from recordings.container.numbering import numbered, numbered_files
from recordings.reading.cursor import Cursor
from recordings.reading.recording import RecordedMessage, Recording, open_recording
from schemas.errors import TouchlineError
from schemas.topic import Topic

_NUMBERED = re.compile(r"(.+)\.(\d{4,})(\.[^.]+)")


class SplitCursor:
    """A position in a recording of one or several files, which may still be growing."""

    def __init__(self, path: Path, keep: Callable[[str], bool] = lambda _: True, *, follow: bool = False) -> None:
        """`path` is a file, or the name that was given to the recorder, with numbered files beside it.

        Without `follow`, a path to an existing file means this file alone. With `follow`, it includes the files after
        it, and the file may still be named `*.part`.

        Raises:
            TouchlineError: a file cannot be read, or is not a recording.
        """
        self._keep, self._follow = keep, follow
        self._recordings: list[Recording] = []
        self._cursors: list[Cursor] = []
        self._at = 0
        self._ended: EndReason | None = None
        first = _first(path, follow=follow)
        self._follows_parts = follow or first != path
        self._append(*self._open_file(first))
        while self._append_next():
            continue
        self._check_end()

    @property
    def recording(self) -> Recording:
        """The first file."""
        return self._recordings[0]

    @property
    def recordings(self) -> list[Recording]:
        """All files, as far as they have been written.

        Raises:
            TouchlineError: the newest file is damaged.
        """
        if not self._recordings[-1].complete:
            self._recordings[-1] = _reopen(self._recordings[-1].path)
        return self._recordings

    @property
    def start_ns(self) -> int:
        """Simulated time of the first message, in ns; 0 if there is none."""
        return self._cursors[0].start_ns

    @property
    def end_ns(self) -> int:
        """Simulated time of the newest message, in ns."""
        return max(cursor.end_ns for cursor in self._cursors)

    @property
    def finished(self) -> bool:
        """Whether the recording is complete: its last file is finished and not followed by another."""
        return self._cursors[-1].finished and not (self._follows_parts and self._goes_on_in_another())

    def grow(self) -> bool:
        """Read what was written since; returns whether anything was.

        Raises:
            TouchlineError: the newest file is damaged.
        """
        grown = self._cursors[-1].grow()
        while self._append_next():
            grown = True
        return grown

    def peek(self) -> RecordedMessage | None:
        """The next message; None at the end.

        Raises:
            TouchlineError: a file is damaged there.
        """
        while True:
            message = self._cursors[self._at].peek()
            if message is None:
                if self._at + 1 >= len(self._cursors):
                    return None
                self._enter(self._at + 1)
            elif self._keep(message.key):
                return message
            else:
                self._cursors[self._at].skip()

    def skip(self) -> None:
        """Move past the next message."""
        self._cursors[self._at].skip()

    def seek(self, ns: int) -> None:
        """Move to the first message at `ns` or later.

        Raises:
            TouchlineError: a file is damaged there.
        """
        at = next((at for at, cursor in enumerate(self._cursors) if cursor.end_ns >= ns), len(self._cursors) - 1)
        self._at = at
        self._cursors[at].seek(ns)  # repeated messages are older: they are from the file before

    def latched(self, ns: int, is_latched: Callable[[Topic], bool]) -> list[RecordedMessage]:
        """The newest message before `ns` on each key of the latched topics, by time.

        Only the file of that time and the one before it are searched.

        Raises:
            TouchlineError: a file is damaged there.
        """
        at = next((at for at, cursor in enumerate(self._cursors) if cursor.end_ns >= ns), len(self._cursors) - 1)
        newest: dict[str, RecordedMessage] = {}
        for cursor in self._cursors[max(0, at - 1) : at + 1]:
            newest |= {message.key: message for message in cursor.latched(ns, is_latched) if self._keep(message.key)}
        return sorted(newest.values(), key=lambda message: message.log_ns)

    def _enter(self, at: int) -> None:
        """Move to the first message of a file that the file before it does not have."""
        self._at = at
        cursor = self._cursors[at]
        cursor.rewind()
        for _ in range(self._recordings[at].manifest.latched_count if at else 0):
            if cursor.peek() is not None:
                cursor.skip()

    def _open_file(self, path: Path) -> tuple[Recording, Cursor]:
        recording = open_recording(path)
        cursor = Cursor(path, self._keep if not self._follows_parts else lambda _: True)
        if recording.complete and not cursor.finished:
            raise TouchlineError(f"{path}: damaged inside (its records cannot be followed); use another copy of it")
        return recording, cursor

    def _append(self, recording: Recording, cursor: Cursor) -> None:
        self._recordings.append(recording)
        self._cursors.append(cursor)
        self._ended = None

    def _append_next(self) -> bool:
        """Open the next file if its recorder has begun it; returns whether it did."""
        if not self._follows_parts or not self._cursors[-1].finished or not self._goes_on_in_another():
            return False
        path = _next_file(self._recordings[-1].path)
        if path is None or not (path.exists() or _partial(path).exists()):
            return False
        path = _current_name(path)
        try:
            recording, cursor = self._open_file(path)
        except TouchlineError:
            if path.suffix == ".part":
                return False  # its manifest is not written yet
            raise
        if cursor.peek() is None and not cursor.finished:
            return False  # the messages it repeats must be there to be skipped
        self._append(recording, cursor)
        return True

    def _check_end(self) -> None:
        """Make sure that no file follows a truncated one, which would never be reached."""
        path = self._recordings[-1].path
        after = _next_file(path)
        if self._follows_parts and not self._cursors[-1].finished and after is not None and after.exists():
            raise TouchlineError(f"{path}: truncated file, and {after.name} comes after it; recover it first")

    def _goes_on_in_another(self) -> bool:
        """Whether another file follows, by the result of the last file, which is finished."""
        if self._ended is None:
            self._recordings[-1] = _reopen(self._recordings[-1].path)
            result = self._recordings[-1].result
            self._ended = result.ended if result is not None else EndReason.HOST_GONE
        return self._ended is EndReason.SPLIT


def _partial(path: Path) -> Path:
    """Name of a file while its recorder writes it."""
    return path.with_name(path.name + ".part")


def _current_name(path: Path) -> Path:
    """Current name of a file: it loses `.part` when it is finished."""
    finished = path.with_suffix("") if path.suffix == ".part" else path
    return finished if finished.exists() or not _partial(finished).exists() else _partial(finished)


def _reopen(path: Path) -> Recording:
    """Open a file again; it may be renamed between the search for it and opening it."""
    try:
        return open_recording(_current_name(path))
    except TouchlineError:
        return open_recording(_current_name(path))


def _first(path: Path, *, follow: bool) -> Path:
    """The first file of the recording at this path."""
    if path.exists():
        return path
    files = numbered_files(path)
    if not files and follow:
        files = [file for file in (_partial(path), _partial(numbered(path, 1))) if file.exists()]
    return files[0] if files else path


def _next_file(path: Path) -> Path | None:
    """The file after this one; None if this one has no number."""
    found = _NUMBERED.fullmatch(path.name.removesuffix(".part"))
    return path.with_name(f"{found[1]}.{int(found[2]) + 1:04d}{found[3]}") if found is not None else None
