"""The numbered files of one recording: their names, and which of them are kept."""

import re
from pathlib import Path

from schemas.errors import TouchlineError


def numbered(path: Path, number: int) -> Path:
    """The file of this number beside a path: `final.mcap` → `final.0001.mcap`."""
    return path.with_name(f"{path.stem}.{number:04d}{path.suffix}")


def files_at(path: Path) -> list[Path]:
    """The finished files of a recording at this path: itself, or its numbered ones."""
    return [path] if path.exists() else numbered_files(path)


def numbered_files(path: Path) -> list[Path]:
    """The numbered files beside a path, in order."""
    pattern = re.compile(re.escape(path.stem) + r"\.\d{4,}" + re.escape(path.suffix))
    if not path.parent.is_dir():
        return []
    return sorted(file for file in path.parent.iterdir() if pattern.fullmatch(file.name))


def check_free(path: Path) -> None:
    """Numbered files of another recording would be taken for this one's."""
    others = numbered_files(path)
    if others:
        raise TouchlineError(f"{others[0]}: is there already; give another name, or move the files away")


def drop_oldest(files: list[Path], keep: int | None) -> None:
    """Delete the oldest of the files until so many are left."""
    while keep is not None and len(files) > keep:
        files.pop(0).unlink(missing_ok=True)
