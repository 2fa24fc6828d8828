"""Where an export goes: it appears under its name when it is whole, and not at all when it fails."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from schemas.errors import TouchlineError


@dataclass(frozen=True, slots=True)
class ExportSummary:
    """What an export has written."""

    out: Path
    written: dict[str, int]
    """Rows or messages, by file or topic."""
    unreadable: dict[str, int] = field(default_factory=dict)
    """Payloads of the recording that are no valid message, by key; they were passed over."""


@contextmanager
def atomic_output(out: Path) -> Iterator[Path]:
    """A path to write to, of the same name as `out`; what was written there is moved to `out` at the end.

    Raises:
        TouchlineError: `out` is there already, or cannot be written.
    """
    if out.exists():
        raise TouchlineError(f"--out {out}: is there already; remove it, or give another name")
    part = out.with_name(out.name + ".part")
    try:
        shutil.rmtree(part, ignore_errors=True)  # of an export that was killed
        part.mkdir(parents=True)
        yield part / out.name
        (part / out.name).replace(out)
    except OSError as error:
        raise TouchlineError(f"--out {out}: {error.strerror or error}; give a path that can be written") from None
    finally:
        shutil.rmtree(part, ignore_errors=True)
