"""The parts of a recording, and their names: `final.mcap`, `final.2.mcap`, `final.3.mcap`.

A part has one writer, which has created it and holds a lock on it. The lock is the operating system's: it ends with its
process, so that the part of a killed recorder is not locked.
"""

import errno
import fcntl
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from shlex import quote
from typing import BinaryIO

from schemas.errors import TouchlineError

_NO_LOCKS = (errno.ENOLCK, errno.EOPNOTSUPP, errno.ENOSYS)
"""Errors of file systems without locks."""


class NotWritableError(TouchlineError):
    """A path cannot be written, for this `reason`."""

    def __init__(self, path: Path, reason: str, remedy: str = "give a path that can be written") -> None:
        super().__init__(f"{path}: {reason}; {remedy}")
        self.reason = reason
        self.remedy = remedy


def part_path(path: Path, number: int) -> Path:
    """The part of this number, from 1: `final.mcap`, 2 → `final.2.mcap`."""
    return path if number == 1 else path.with_name(f"{path.stem}.{number}{path.suffix}")


def parts_of(path: Path) -> list[Path]:
    """The parts that are there of the recording at this path, in order."""
    parts: list[Path] = []
    while (part := part_path(path, len(parts) + 1)).exists():
        parts.append(part)
    return parts


def remove_parts(path: Path) -> None:
    """Delete the recording at this path, if there is one."""
    for part in parts_of(path):
        part.unlink()


def create_part(path: Path) -> BinaryIO:
    """Create and lock a file.

    Raises:
        NotWritableError: there is such a file already, or it cannot be written.
    """
    if not path.parent.exists():
        folder = quote(str(path.parent))
        raise NotWritableError(path, f"the folder {folder} does not exist", f"make it with: mkdir -p {folder}")
    try:
        file = path.open("xb")
        _lock(file)
    except FileExistsError:
        remedy = "name another file, or move that one away"
        raise NotWritableError(path, "is a folder" if path.is_dir() else "already exists", remedy) from None
    except OSError as error:
        raise NotWritableError(path, error.strerror or "cannot be written") from None
    return file


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Lock an existing file against recorders.

    Raises:
        TouchlineError: a recorder is writing the file.
        OSError: the file cannot be opened.
    """
    with path.open("rb") as file:
        if not _lock(file):
            raise TouchlineError(f"{path}: is being written by a recorder; end that one, or wait until it has ended")
        yield


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
