"""`touchline recover`: repairs recordings in place."""

import json as json_text
from dataclasses import asdict
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from touchline.cli import options

if TYPE_CHECKING:
    from recordings.editing.recovery import RecoverySummary


def recover(
    files: Annotated[list[Path], typer.Argument(metavar="FILE...", help="Recordings: *.mcap or *.mcap.part.")],
    json: options.Json = False,
) -> None:
    """Repair truncated or damaged recordings in place.

    Intact recordings are not changed. A repaired *.mcap.part loses the suffix .part.

    Example: touchline recover final.mcap.part
    """
    from recordings.editing.recovery import recover
    from recordings.reading.recording import open_recording

    done = []
    for file in chain.from_iterable(_files_of(file) for file in files):
        done.append(recover(file))
        open_recording(done[-1].path)  # raises if the rest is not a recording
        if not json:
            typer.echo(_sentence(done[-1]))
    if json:
        facts = [{**asdict(one), "path": str(one.path), "rest": str(one.rest) if one.rest else None} for one in done]
        typer.echo(json_text.dumps(facts))


def _files_of(path: Path) -> list[Path]:
    """The file, or all files of the split recording of this name."""
    from recordings.container.numbering import numbered_files, unfinished_files

    split = [*numbered_files(path), *unfinished_files(path)] if not path.exists() else []
    return split or [path]


def _sentence(done: "RecoverySummary") -> str:
    if not done.repaired:
        return f"{done.path}: intact, {done.messages} messages"
    parts = [f"{done.path}: repaired, {done.messages} messages", f"{done.cut} bytes removed from the end"]
    if done.damaged:
        parts.append(f"{done.damaged} damaged records left out")
    if done.rest is not None:
        parts.append(f"the removed bytes are in {done.rest}")
    return ", ".join(parts)
