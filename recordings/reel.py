"""A recording that was split into files, as one tape: from the first of them, or from any, to the last.

What a file repeats at its beginning, to be read by itself, is passed over where the file before it was played.
"""

import re
from collections.abc import Callable
from pathlib import Path

from recordings.manifest import Ended
from recordings.numbering import numbered, numbered_files
from recordings.reader import Recorded, Recording, open_recording
from recordings.tape import Tape
from schemas.errors import TouchlineError
from schemas.topic import Topic

_NUMBERED = re.compile(r"(.+)\.(\d{4,})(\.[^.]+)")


class Reel:
    """The files of one recording, in order; it grows with the newest, and by those that a recorder begins after it."""

    def __init__(self, path: Path, keep: Callable[[str], bool] = lambda _: True, *, follow: bool = False) -> None:
        """`path` is a file; or the name that was given to the recorder, whose files are numbered beside it.

        Without `follow` a file that is named itself is all of it; with it, what comes after it belongs to it, and it
        may still be called `*.part`.

        Raises:
            TouchlineError: it cannot be read, or is not a recording.
        """
        self._keep, self._follow = keep, follow
        self._recordings: list[Recording] = []
        self._tapes: list[Tape] = []
        self._at = 0
        self._ended: Ended | None = None
        first = _first(path, follow=follow)
        self._goes_on = follow or first != path
        self._take_in(*self._opened(first))
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
            TouchlineError: the newest is damaged.
        """
        if not self._recordings[-1].complete:
            self._recordings[-1] = _opened_again(self._recordings[-1].path)
        return self._recordings

    @property
    def start_ns(self) -> int:
        """Simulated time of the first message, in ns; 0 when there is none."""
        return self._tapes[0].start_ns

    @property
    def end_ns(self) -> int:
        """Simulated time of the newest message, in ns."""
        return max(tape.end_ns for tape in self._tapes)

    @property
    def finished(self) -> bool:
        """Nothing will be added: the last file is finished, and does not say that there is another."""
        return self._tapes[-1].finished and not (self._goes_on and self._is_split())

    def grow(self) -> bool:
        """Look for what was written since; whether anything was.

        Raises:
            TouchlineError: the newest file is damaged.
        """
        grown = self._tapes[-1].grow()
        while self._append_next():
            grown = True
        return grown

    def peek(self) -> Recorded | None:
        """The message that it stands at; nothing at its end.

        Raises:
            TouchlineError: a file is damaged there.
        """
        while True:
            message = self._tapes[self._at].peek()
            if message is None:
                if self._at + 1 >= len(self._tapes):
                    return None
                self._enter(self._at + 1)
            elif self._keep(message.key):
                return message
            else:
                self._tapes[self._at].skip()

    def skip(self) -> None:
        """Go on behind the message that it stands at."""
        self._tapes[self._at].skip()

    def seek(self, ns: int) -> None:
        """Stand before the first message at `ns` or later.

        Raises:
            TouchlineError: a file is damaged there.
        """
        at = next((at for at, tape in enumerate(self._tapes) if tape.end_ns >= ns), len(self._tapes) - 1)
        self._at = at
        self._tapes[at].seek(ns)  # later than all that a file repeats, which is as old as the file before it

    def standing(self, ns: int, of: Callable[[Topic], bool]) -> list[Recorded]:
        """The newest message before `ns` of every key of these topics, in order.

        Looked for in the file of that time and in the one before it.

        Raises:
            TouchlineError: a file is damaged there.
        """
        at = next((at for at, tape in enumerate(self._tapes) if tape.end_ns >= ns), len(self._tapes) - 1)
        newest: dict[str, Recorded] = {}
        for tape in self._tapes[max(0, at - 1) : at + 1]:
            newest |= {message.key: message for message in tape.standing(ns, of) if self._keep(message.key)}
        return sorted(newest.values(), key=lambda message: message.log_ns)

    def _enter(self, at: int) -> None:
        """Stand at the first message of a file that is not in the one before it."""
        self._at = at
        tape = self._tapes[at]
        tape.rewind()
        for _ in range(self._recordings[at].manifest.standing if at else 0):
            if tape.peek() is not None:
                tape.skip()

    def _opened(self, path: Path) -> tuple[Recording, Tape]:
        recording = open_recording(path)
        tape = Tape(path, self._keep if not self._goes_on else lambda _: True)
        if recording.complete and not tape.finished:
            raise TouchlineError(f"{path}: damaged inside (its records cannot be followed); take another copy of it")
        return recording, tape

    def _take_in(self, recording: Recording, tape: Tape) -> None:
        self._recordings.append(recording)
        self._tapes.append(tape)
        self._ended = None

    def _append_next(self) -> bool:
        """Take in the next file, where there is one that has begun."""
        if not self._goes_on or not self._tapes[-1].finished or not self._is_split():
            return False
        path = _after(self._recordings[-1].path)
        if path is None or not (path.exists() or _part(path).exists()):
            return False
        path = _named(path)
        try:
            recording, tape = self._opened(path)
        except TouchlineError:
            if path.suffix == ".part":
                return False  # its head is not written yet
            raise
        if tape.peek() is None and not tape.finished:
            return False  # what it repeats has to be there, to be passed over
        self._take_in(recording, tape)
        return True

    def _check_end(self) -> None:
        """A file that was cut off hides those after it, unless its recorder is still at it."""
        path = self._recordings[-1].path
        after = _after(path)
        if self._goes_on and not self._tapes[-1].finished and after is not None and after.exists():
            raise TouchlineError(f"{path}: truncated file, and {after.name} comes after it; recover it first")

    def _is_split(self) -> bool:
        """Whether the last file, which is finished, says that it goes on in another."""
        if self._ended is None:
            self._recordings[-1] = _opened_again(self._recordings[-1].path)
            result = self._recordings[-1].result
            self._ended = result.ended if result is not None else Ended.HOST_GONE
        return self._ended is Ended.SPLIT


def _part(path: Path) -> Path:
    """What a file is called while its recorder writes it."""
    return path.with_name(path.name + ".part")


def _named(path: Path) -> Path:
    """A file by the name that it has now: it loses `.part` when it is finished."""
    finished = path.with_suffix("") if path.suffix == ".part" else path
    return finished if finished.exists() or not _part(finished).exists() else _part(finished)


def _opened_again(path: Path) -> Recording:
    """A file as it is now; it may be given its name between a look for it and opening it."""
    try:
        return open_recording(_named(path))
    except TouchlineError:
        return open_recording(_named(path))


def _first(path: Path, *, follow: bool) -> Path:
    """The first file of what this path names."""
    if path.exists():
        return path
    files = numbered_files(path)
    if not files and follow:
        files = [file for file in (_part(path), _part(numbered(path, 1))) if file.exists()]
    return files[0] if files else path


def _after(path: Path) -> Path | None:
    """The file that follows this one; nothing when this one has no number."""
    found = _NUMBERED.fullmatch(path.name.removesuffix(".part"))
    return path.with_name(f"{found[1]}.{int(found[2]) + 1:04d}{found[3]}") if found is not None else None
