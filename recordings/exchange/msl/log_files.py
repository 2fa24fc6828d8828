"""The files of a log, wherever they are: in a zip, in a folder, or named one by one."""

import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from zipfile import BadZipFile, ZipFile, is_zipfile

from schemas.errors import TouchlineError

_MAX_BYTES = 2**31
"""Bytes of one file; the log of a match has some tens of millions."""


@dataclass(slots=True)
class LogFiles:
    """What they hold, as text."""

    name: str
    """Of the log, without its suffixes."""
    teams: dict[str, str] = field(default_factory=dict)
    """A or B → its world states."""
    events: str | None = None
    """The referee's signals."""
    broken: list[str] = field(default_factory=list)
    """Files with bytes that are no UTF-8; they were replaced."""


def log_files(paths: list[Path]) -> LogFiles:
    """Read `<time>.A.msl`, `<time>.B.msl` and `<time>.msl`.

    Raises:
        TouchlineError: a path that cannot be read, no such file among them, or those of several logs.
    """
    log = LogFiles(paths[0].name.split(".")[0])
    seen: dict[str, str] = {}
    for name, content in _contents(paths):
        kind = _kind(PurePosixPath(name).name)
        if kind is None:
            continue
        if kind in seen:
            raise TouchlineError(f"{name}: a second log beside {seen[kind]}; give the files of one match")
        seen[kind] = name
        text = content.decode("utf-8-sig", errors="replace")
        if "\ufffd" in text:
            log.broken.append(name)
        if kind == "events":
            log.events = text
        else:
            log.teams[kind] = text
    if not log.teams:
        raise TouchlineError(f"{paths[0]}: no log of the league; give a zip, or a folder, or its *.A.msl and *.B.msl")
    return log


def _kind(name: str) -> str | None:
    """A, B or events; nothing for a file that is none of a log, or that merges the others."""
    words = name.lower().split(".")
    if words[-1] != "msl" or len(words) < 2 or words[-2] == "merged":
        return None
    return words[-2].upper() if words[-2] in ("a", "b") else "events"


def _contents(paths: list[Path]) -> Iterator[tuple[str, bytes]]:
    for path in paths:
        try:
            if path.is_dir():
                yield from ((str(file), file.read_bytes()) for file in sorted(path.glob("*.msl")))
            elif is_zipfile(path):
                yield from _zipped(path)
            else:
                yield str(path), path.read_bytes()
        except OSError as error:
            raise TouchlineError(f"{path}: {error.strerror or error}; give the path of a log") from None


def _zipped(path: Path) -> Iterator[tuple[str, bytes]]:
    try:
        with ZipFile(path) as archive:
            for member in archive.infolist():
                if _kind(PurePosixPath(member.filename).name) is None:
                    continue
                if member.file_size > _MAX_BYTES:
                    raise TouchlineError(f"{path}: {member.filename} has {member.file_size} bytes; that is no log")
                yield f"{path}/{member.filename}", archive.read(member)
    except (BadZipFile, zlib.error, RuntimeError, NotImplementedError, EOFError) as error:
        raise TouchlineError(f"{path}: damaged zip ({error}); take another copy, or give its files") from None
