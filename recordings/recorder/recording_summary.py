"""What a recorder has recorded when it ends."""

from dataclasses import dataclass
from pathlib import Path

from recordings.container.manifest import Result


@dataclass(frozen=True, slots=True)
class RecordingSummary:
    """What was recorded."""

    files: list[Path]
    """The files, the oldest first."""
    size: int
    """Bytes of all files."""
    result: Result
    """The result of the last file."""
