"""`touchline merge`: several recordings of one match in one."""

from pathlib import Path
from typing import Annotated

import typer


def merge(
    files: Annotated[list[Path], typer.Argument(metavar="FILE...", help="Recordings of one match, *.mcap.")],
    out: Annotated[Path, typer.Option(help="The file to write, *.mcap.")],
) -> None:
    """Write several recordings of one match into one: the files of a split one, or those of two recorders.

    A message that several of them have is written once.

    Example: touchline merge final.0001.mcap final.0002.mcap --out final.mcap
    """
    from recordings.editing.merging import merge_recordings
    from recordings.reading.recording import open_recording

    copied = merge_recordings([open_recording(file) for file in files], out)
    typer.echo(f"{copied.path}: {copied.messages} messages; {copied.dropped} that several files have are in it once")
