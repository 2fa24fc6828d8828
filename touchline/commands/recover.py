"""`touchline recover`: repairs recordings."""

from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from touchline.commands.cli import options
from touchline.launch.terminal.json_text import json_text

if TYPE_CHECKING:
    from recordings.editing.recovery import RecoverySummary


def recover(
    files: Annotated[list[Path], typer.Argument(metavar="FILE...", help="Recordings, any *.mcap files, bag folders.")],
    json: options.Json = False,
) -> None:
    """Repair truncated or damaged recordings.

    Intact recordings are not changed. All parts of a recording are repaired. Where more than an unfinished chunk is
    lost, the damaged file is kept as FILE.damaged.

    Example: touchline recover final.mcap
    """
    from recordings.container.parts import parts_of
    from recordings.editing.recovery import recover
    from recordings.reading.log_order import files_of, is_match
    from recordings.reading.recording import open_recording

    done = []
    for file in chain.from_iterable(parts_of(file) or [file] for file in files_of(files)):
        done.append(recover(file))
        if is_match([file]):
            open_recording(file)  # raises if the rest is not a recording
        if not json:
            typer.echo(_sentence(done[-1]))
    if json:
        typer.echo(json_text(done))


def _sentence(done: "RecoverySummary") -> str:
    if not done.repaired:
        return f"{done.path}: intact, {done.messages} messages"
    parts = [f"{done.path}: repaired, {done.messages} messages", f"{done.cut} bytes removed from the end"]
    if done.damaged:
        parts.append(f"{done.damaged} damaged records left out")
    if done.original is not None:
        parts.append(f"the damaged file is {done.original}")
    return ", ".join(parts)
