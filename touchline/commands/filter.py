"""`touchline filter`: a part of a recording."""

from pathlib import Path
from typing import Annotated

import typer

from touchline.cli import options


def filter(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The recording, *.mcap.")],
    out: Annotated[Path, typer.Option(help="The file to write, *.mcap.")],
    include: options.Include = None,
    exclude: options.Exclude = None,
    start: Annotated[float | None, typer.Option("--from", help="Simulated s that the copy begins at.")] = None,
    end: Annotated[float | None, typer.Option("--to", help="Simulated s that it ends before.")] = None,
) -> None:
    """Copy a part of a recording: some keys, some seconds. Every message keeps its bytes, times and number.

    Example: touchline filter match.mcap --out commands.mcap --include "robot/*/command" --from 10 --to 20
    """
    from recordings.editing.filtering import filter_recording
    from recordings.reading.recording import open_recording

    copied = filter_recording(open_recording(file), out, options.selection(include, exclude), start, end)
    typer.echo(f"{copied.path}: {copied.messages} messages")
