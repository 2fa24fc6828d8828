"""The file that is written before it has its name: `final.mcap.part`. It has one writer at a time, who holds it.

The hold is a lock of the operating system's on the open file: it ends with its process, however that ends, so what a
killed recorder leaves is held by nobody.
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
"""What a file system says that knows no locks; there two writers of one path are on their own."""


class NotWritableError(TouchlineError):
    """Nothing can be written there, for this `reason`."""

    def __init__(self, path: Path, reason: str, remedy: str = "give a path that can be written") -> None:
        super().__init__(f"{path}: {reason}; {remedy}")
        self.reason = reason


class PartialFile:
    """A file of one's own that is being written."""

    def __init__(self, path: Path) -> None:
        """`path` is the name that it will have. What is left of a writer that died becomes `*.part.old`.

        Raises:
            NotWritableError: another writes it, and nothing of that was touched; or the disk refuses.
        """
        self._path = path
        self.path = path.with_name(path.name + ".part")
        """Its name until it is finished."""
        if path.is_dir():
            raise NotWritableError(path, "is a folder")
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            file = _acquire(self.path)
        except OSError as error:
            raise NotWritableError(path, error.strerror or "cannot be written") from None
        if file is None:
            raise NotWritableError(path, "is being written by another recorder", "give another --out, or end that one")
        self.file = file

    def finish(self) -> None:
        """Give it its name, and let go of it. What was written has to be flushed.

        Raises:
            OSError: it cannot be renamed; it stays as it is, and held.
        """
        self.path.replace(self._path)  # while it is held: nobody takes it for what a dead writer left
        self.file.close()

    def close(self) -> None:
        """Let go of it as it is; does nothing where that was done.

        Raises:
            OSError: what was not yet flushed cannot be written.
        """
        self.file.close()

    def discard(self) -> None:
        """Leave no file; does nothing where it was let go of.

        Raises:
            OSError: it cannot be removed.
        """
        if not self.file.closed:
            self.path.unlink(missing_ok=True)
            self.file.close()


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold a file that is there, whatever it is called, so that nobody writes it meanwhile.

    Raises:
        TouchlineError: somebody writes it now.
        OSError: it cannot be opened.
    """
    with path.open("rb") as file:
        if not _lock(file):
            raise TouchlineError(f"{path}: is being written by a recorder; end that one, or wait until it has ended")
        yield


def _acquire(part: Path) -> BinaryIO | None:
    """The empty file of this name, held; nothing where another holds it."""
    while True:
        file = part.open("ab")  # cuts off nothing before it is known whose it is
        try:
            if not _lock(file):
                file.close()
                return None
            ours = os.fstat(file.fileno())
            is_there = _is_at(part, ours)
            if is_there and ours.st_size == 0:
                return file
            if is_there:
                part.replace(part.with_name(part.name + ".old"))
        except BaseException:
            file.close()
            raise
        file.close()  # it was set aside, or another has finished it just now: the name is free for a new one


def _is_at(path: Path, ours: os.stat_result) -> bool:
    """Whether this file, and no other, has the name."""
    try:
        return os.path.samestat(ours, path.stat())
    except FileNotFoundError:
        return False


def _lock(file: BinaryIO) -> bool:
    """Whether nobody else holds it."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError as error:
        if error.errno not in _NO_LOCKS:
            raise
    return True
