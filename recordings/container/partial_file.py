"""A file that is being written: `final.mcap.part`. A lock makes sure that it has one writer at a time.

The lock is the operating system's, on the open file. It ends with its process, so that the file of a killed recorder is
not locked.
"""

import errno
import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from schemas.errors import TouchlineError

_NO_LOCKS = (errno.ENOLCK, errno.EOPNOTSUPP, errno.ENOSYS)
"""Errors of file systems without locks. There nothing keeps two writers off one path."""


class NotWritableError(TouchlineError):
    """A path cannot be written, for this `reason`."""

    def __init__(self, path: Path, reason: str, remedy: str = "give a path that can be written") -> None:
        super().__init__(f"{path}: {reason}; {remedy}")
        self.reason = reason
        self.remedy = remedy


class PartialFile:
    """A file that is being written, and locked."""

    def __init__(self, path: Path, *, resume: bool = False) -> None:
        """`path` is the name of the finished file. A file left by a killed writer is renamed to `*.part.old`.

        With `resume` it is kept, to be appended to.

        Raises:
            NotWritableError: another writer has locked the file, which is left unchanged; or it cannot be written.
        """
        self._path = path
        self.path = path.with_name(path.name + ".part")
        """Name of the file until it is finished."""
        if path.is_dir():
            raise NotWritableError(path, "is a folder")
        if not path.parent.exists():
            folder = path.parent
            raise NotWritableError(path, f"the folder {folder} does not exist", f"make it with: mkdir -p {folder}")
        try:
            file = _acquire(self.path, resume=resume)
        except OSError as error:
            raise NotWritableError(path, error.strerror or "cannot be written") from None
        if file is None:
            raise NotWritableError(path, "is being written by another recorder", "name another file, or end that one")
        self.file = file

    def finish(self) -> None:
        """Rename the file to its final name and unlock it. The caller has to flush it before.

        Raises:
            OSError: the file cannot be renamed; it remains as it is, and locked.
        """
        self.path.replace(self._path)  # while locked, so that no other writer sets it aside
        self.file.close()

    def close(self) -> None:
        """Close and unlock the file as it is; has no effect on a closed file.

        Raises:
            OSError: buffered data cannot be written.
        """
        self.file.close()

    def discard(self) -> None:
        """Remove the file; has no effect on a closed file.

        Raises:
            OSError: the file cannot be removed.
        """
        if not self.file.closed:
            self.path.unlink(missing_ok=True)
            self.file.close()


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Lock an existing file of any name against recorders.

    Raises:
        TouchlineError: a recorder is writing the file.
        OSError: the file cannot be opened.
    """
    with path.open("rb") as file:
        if not _lock(file):
            raise TouchlineError(f"{path}: is being written by a recorder; end that one, or wait until it has ended")
        yield


def _acquire(part: Path, *, resume: bool) -> BinaryIO | None:
    """Open and lock an empty file of this name, or, to `resume`, any; None if another process has locked it."""
    while True:
        file = part.open("ab")  # must not truncate a file that may be another writer's
        try:
            if not _lock(file):
                file.close()
                return None
            ours = os.fstat(file.fileno())
            is_there = _is_at(part, ours)
            if is_there and (resume or ours.st_size == 0):
                return file
            if is_there:
                part.replace(part.with_name(part.name + ".old"))
        except BaseException:
            file.close()
            raise
        file.close()  # it was set aside, or finished by another writer: the name is free


def _is_at(path: Path, ours: os.stat_result) -> bool:
    """Whether the file at this path is the same as `ours`."""
    try:
        return os.path.samestat(ours, path.stat())
    except FileNotFoundError:
        return False


def _lock(file: BinaryIO) -> bool:
    """Lock a file; returns whether that was possible."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError as error:
        if error.errno not in _NO_LOCKS:
            raise
    return True
