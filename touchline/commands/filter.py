"""`touchline filter`: copies a part of a recording."""

from pathlib import Path
from typing import Annotated

import typer

from touchline.commands.cli import options


def filter(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The recording, *.mcap.")],
    out: Annotated[Path, typer.Option(help="The file to write, *.mcap.")],
    include: options.Include = None,
    exclude: options.Exclude = None,
    start: options.From = None,
    end: options.To = None,
) -> None:
    """Copy a part of a recording, selected by key and time. Messages keep their bytes, times and numbers.

    Example: touchline filter match.mcap --out commands.mcap --include "robot/*/command" --from 10 --to 20
    """
    from recordings.editing.filtering import filter_recording
    from recordings.reading.recording import open_recording

    options.check_span(start, end)
    messages = filter_recording(open_recording(file), out, options.selection(include, exclude), start, end)
    typer.echo(f"{out}: {messages} messages")
