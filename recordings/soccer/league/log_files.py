"""Reads the files of a log: from a zip, from a folder, or given one by one."""

import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile, is_zipfile

from schemas.errors import TouchlineError, os_errors

_MAX_BYTES = 2**29
"""Most bytes of all files of a log. Chosen here: four times what the 40 minutes of a final of 2016 have."""
_LITTLE = 2**25
_PACKS = 200
"""Times that a log of more than `_LITTLE` bytes is larger than its zip, at most. Chosen here: in 2016 it was 36 times
larger; zeros are 1000 times larger."""

_ZIP = b"PK\x03\x04"
"""First bytes of a zip."""


@dataclass(slots=True)
class LogFiles:
    """The files of a log, as text."""

    name: str
    """Name of the log, without suffixes."""
    teams: dict[str, str] = field(default_factory=dict)
    """A or B → world states of the team."""
    events: str | None = None
    """Signals of the referee; None if that file is missing."""
    broken: list[str] = field(default_factory=list)
    """Files with bytes that are not UTF-8, which were replaced."""


def log_files(paths: list[Path]) -> LogFiles:
    """Read `<time>.A.msl`, `<time>.B.msl` and `<time>.msl`.

    Raises:
        TouchlineError: a path cannot be read, there is no team's file among them, or there are several logs.
    """
    log = LogFiles(paths[0].name.split(".")[0])
    seen: dict[str, str] = {}
    for name, content in _contents(paths):
        kind = _kind(PurePosixPath(name).name)
        if kind is None:
            continue
        if kind in seen:
            raise TouchlineError(f"{name}: belongs to another log than {seen[kind]}; give the files of one match")
        seen[kind] = name
        text = content.decode("utf-8-sig", errors="replace")
        if "\ufffd" in text:
            log.broken.append(name)
        if kind == "events":
            log.events = text
        else:
            log.teams[kind] = text
    if not log.teams:
        raise TouchlineError(f"{paths[0]}: not a log of the league; give a zip, a folder, or its *.A.msl and *.B.msl")
    return log


def _kind(name: str) -> str | None:
    """`A`, `B` or `events`; None for a file that is not part of a log, or that merges the others."""
    parts = name.lower().split(".")
    if parts[-1] != "msl" or len(parts) < 2 or parts[-2] == "merged":
        return None
    return parts[-2].upper() if parts[-2] in ("a", "b") else "events"


def _contents(paths: list[Path]) -> Iterator[tuple[str, bytes]]:
    plain = [file for path in paths for file in (path.glob("*.msl") if path.is_dir() else (path,))]
    other = next((file for file in plain if file.exists() and not file.is_file()), None)
    if other is not None:
        raise TouchlineError(f"{other}: not a file; give the path of a log")
    if sum(file.stat().st_size for file in plain if file.exists()) > _MAX_BYTES:
        raise TouchlineError(f"{paths[0]}: more than {_MAX_BYTES >> 20} MiB, too many for a log; give the files of one")
    for path in paths:
        with os_errors(path, "give the path of a log"):
            if path.is_dir():
                yield from ((str(file), file.read_bytes()) for file in sorted(path.glob("*.msl")))
            elif is_zipfile(path):
                yield from _zipped(path)
            else:
                content = path.read_bytes()
                if content.startswith(_ZIP):
                    raise TouchlineError(
                        f"{path}: truncated zip, its table of contents is missing ({len(content)} bytes are there); "
                        "use another copy, or give the files that can be unpacked from it"
                    )
                yield str(path), content


def _zipped(path: Path) -> Iterator[tuple[str, bytes]]:
    try:
        with ZipFile(path) as archive:
            members = [one for one in archive.infolist() if _kind(PurePosixPath(one.filename).name) is not None]
            size = sum(one.file_size for one in members)
            if size > _MAX_BYTES or size > max(_LITTLE, _PACKS * path.stat().st_size):
                raise TouchlineError(f"{path}: its files claim {size} bytes, too many for a log; give its files")
            if any(one.compress_type not in (ZIP_STORED, ZIP_DEFLATED) for one in members):
                raise NotImplementedError("its files are packed in another way than deflate")
            for member in members:
                yield f"{path}/{member.filename}", archive.read(member)
    except (BadZipFile, zlib.error, RuntimeError, NotImplementedError, EOFError) as error:
        raise TouchlineError(f"{path}: damaged zip ({error}); use another copy, or give its files") from None
