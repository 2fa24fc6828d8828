"""The numbered files of one recording: their names."""

import re
from pathlib import Path

from schemas.errors import TouchlineError


def numbered(path: Path, number: int) -> Path:
    """The numbered file beside a path: `final.mcap` → `final.0001.mcap`."""
    return path.with_name(f"{path.stem}.{number:04d}{path.suffix}")


def files_at(path: Path) -> list[Path]:
    """The finished files of the recording at this path: the file itself, or its numbered files."""
    return [path] if path.exists() else numbered_files(path)


def unfinished_at(path: Path) -> list[Path]:
    """The unfinished files of the recording at this path."""
    part = path.with_name(path.name + ".part")
    return [part] if part.exists() else unfinished_files(path)


def numbered_files(path: Path) -> list[Path]:
    """The numbered files beside a path, in order."""
    return _numbered_files(path, path.suffix)


def unfinished_files(path: Path) -> list[Path]:
    """The numbered files beside a path that are named `*.part`, in order."""
    return _numbered_files(path, path.suffix + ".part")


def _numbered_files(path: Path, suffix: str) -> list[Path]:
    pattern = re.compile(re.escape(path.stem) + r"\.(\d{4,})" + re.escape(suffix))
    if not path.parent.is_dir():
        return []
    found = [(int(match[1]), file) for file in path.parent.iterdir() if (match := pattern.fullmatch(file.name))]
    return [file for _, file in sorted(found)]


def check_free(path: Path) -> None:
    """Make sure that no numbered files exist: those of another recording would be mistaken for this one's.

    Raises:
        TouchlineError: there are such files.
    """
    others = numbered_files(path)
    if others:
        raise TouchlineError(f"{others[0]}: already exists; give another name, or move the files away")
