"""`touchline merge`: merges several recordings of one match."""

from pathlib import Path
from typing import Annotated

import typer


def merge(
    files: Annotated[list[Path], typer.Argument(metavar="FILE...", help="Recordings of one match, *.mcap.")],
    out: Annotated[Path, typer.Option(help="The file to write, *.mcap.")],
) -> None:
    """Merge recordings of one match: the files of a split recording, or those of two recorders.

    Duplicate messages are written once.

    Example: touchline merge final.0001.mcap final.0002.mcap --out final.mcap
    """
    from recordings.editing.merging import merge_recordings
    from recordings.reading.recording import open_recording

    copied = merge_recordings([open_recording(file) for file in files], out)
    typer.echo(f"{copied.path}: {copied.messages} messages; {copied.dropped} duplicates dropped")
