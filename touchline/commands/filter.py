"""`touchline filter`: copies a part of a recording."""

from pathlib import Path
from typing import Annotated

import typer

from schemas.errors import TouchlineError
from touchline.commands.cli import options


def filter(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE...", help="The recording, or any *.mcap files and bag folders.")
    ],
    out: Annotated[Path, typer.Option(help="The file to write, *.mcap.")],
    include: options.Include = None,
    exclude: options.Exclude = None,
    start: options.From = None,
    end: options.To = None,
) -> None:
    """Copy a part of a recording, selected by key and time. Messages keep their bytes, times and numbers.

    Any other MCAP files become one, in the order of log times; --from and --to are seconds since their first message.

    Example: touchline filter match.mcap --out commands.mcap --include "robot/*/command" --from 10 --to 20

    Example: touchline filter robot1.mcap robot2.mcap bag --out all.mcap
    """
    from recordings.editing.filtering import filter_recording
    from recordings.editing.log_copy import copy_log
    from recordings.reading.log_order import is_match
    from recordings.reading.recording import open_recording

    options.check_span(start, end)
    if out.exists():
        raise TouchlineError(f"{out}: already exists; name another file, or move that one away")
    selection = options.selection(include, exclude)
    if is_match(files):
        messages = filter_recording(open_recording(files[0]), out, selection, start, end)
    else:
        messages = copy_log(files, out, selection, start, end)
    typer.echo(f"{out}: {messages} messages")
