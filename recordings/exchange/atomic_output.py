"""Output of an export: it appears under its name when it is complete, and not at all if the export fails."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from schemas.errors import TouchlineError
from schemas.process.whole_file import written_whole


@dataclass(frozen=True, slots=True)
class ExportSummary:
    """The result of an export."""

    out: Path
    written: dict[str, int]
    """File or topic → rows or messages."""
    unreadable: dict[str, int] = field(default_factory=dict)
    """Key → payloads of the recording that were skipped because they are not valid messages."""
    omitted: dict[str, int] = field(default_factory=dict)
    """Key expression → messages of the recording for which the format has no place."""


@contextmanager
def atomic_output(out: Path) -> Iterator[Path]:
    """Return a temporary path with the name of `out`; what is written there is moved to `out` at the end.

    Raises:
        TouchlineError: `out` already exists, or cannot be written.
    """
    if out.exists():
        raise TouchlineError(f"--out {out}: already exists; remove it, or give another name")
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with written_whole(out) as draft:
            yield draft
    except OSError as error:
        raise TouchlineError(f"--out {out}: {error.strerror or error}; give a path that can be written") from None
