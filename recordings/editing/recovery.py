"""Repairs a recording in place: adds a missing index, and leaves out damaged records.

Undamaged chunks are not moved, so that a repair of a hundred megabytes takes less than a second. No data is made up: a
chunk is kept only if its checksum is right.
"""

from dataclasses import dataclass
from pathlib import Path

from recordings.container.parts import locked
from recordings.container.repair import examine, execute
from schemas.errors import TouchlineError


@dataclass(frozen=True, slots=True)
class RecoverySummary:
    """The result of a repair."""

    path: Path
    repaired: bool
    """False if the file was undamaged."""
    messages: int
    """Messages in the repaired file, without those for viewers."""
    cut: int
    """Bytes cut off at the end."""
    rest: Path | None
    """File with these bytes, if they are more than an unfinished chunk."""
    damaged: int
    """Damaged records that were left out."""


def recover(path: Path) -> RecoverySummary:
    """Repair a file in place.

    Raises:
        TouchlineError: the file cannot be read or written, is being recorded, is not MCAP, or has no intact record.
    """
    try:
        with locked(path):
            done, plan = examine(path)
            if plan is not None:
                execute(path, plan)
        return RecoverySummary(
            path=path,
            repaired=plan is not None,
            messages=done.messages,
            cut=done.cut,
            rest=plan.rest[0] if plan is not None and plan.rest is not None else None,
            damaged=done.damaged,
        )
    except OSError as error:
        raise TouchlineError(f"{path}: {error.strerror}; give the path of a recording that can be written") from None
