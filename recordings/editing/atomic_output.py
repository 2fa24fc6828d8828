"""Output of an export: it appears under its name when it is complete, and not at all if the export fails."""

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from recordings.reading.recording import Recording
from runtime.process.whole_file import written_whole
from schemas.errors import TouchlineError, os_errors
from schemas.topic import Topic
from schemas.topics import TOPICS


@dataclass(frozen=True, slots=True)
class ExportSummary:
    """The result of an export."""

    out: Path
    written: dict[str, int]
    """File or topic → rows or messages."""
    unreadable: dict[str, int]
    """Key → payloads of the recording that were skipped because they are not valid messages."""
    omitted: dict[str, int]
    """Key expression, `robot/*/sight` → messages of the recording for which the format has no place, sorted."""

    @classmethod
    def of(cls, recording: Recording, out: Path, written: dict[str, int], *exported: Topic) -> Self:
        """The summary of an export of these topics."""
        omitted: Counter[str] = Counter()
        for channel in recording.channels:
            topic = TOPICS.get(channel.topic)
            if topic not in exported and channel.messages:
                omitted[topic.fill() if topic is not None else channel.key] += channel.messages
        return cls(out, written, dict(recording.unreadable), dict(sorted(omitted.items())))


@contextmanager
def atomic_output(out: Path) -> Iterator[Path]:
    """Return a temporary path with the name of `out`; what is written there is moved to `out` at the end.

    Raises:
        TouchlineError: `out` already exists, or cannot be written.
    """
    if out.exists():
        raise TouchlineError(f"--out {out}: already exists; remove it, or give another name")
    with os_errors(f"--out {out}", "give a path that can be written"):
        out.parent.mkdir(parents=True, exist_ok=True)
        with written_whole(out) as draft:
            yield draft
