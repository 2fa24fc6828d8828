"""`touchline export`: a recording in another format."""

from pathlib import Path
from typing import Annotated

import typer

from recordings.exchange.formats import EXPORTERS
from schemas.errors import TouchlineError, did_you_mean
from touchline.commands.cli import options
from touchline.launch.terminal.json_text import json_text

_FORMATS = f"One of: {'; '.join(f'{name}, {row.description}' for name, row in EXPORTERS.items())}."


def export(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The recording, *.mcap.")],
    name: Annotated[str, typer.Option("--format", help=_FORMATS)],
    out: Annotated[
        Path | None, typer.Option(help="The file or folder to write; by default in the recording's folder.")
    ] = None,
    json: options.Json = False,
) -> None:
    """Write a recording in another format.

    Example: touchline export final.mcap --format csv --out final
    """
    from recordings.reading.recording import open_recording

    if name not in EXPORTERS:
        raise TouchlineError(f'--format is "{name}"; {did_you_mean(name, EXPORTERS)}')
    exporter = EXPORTERS[name]
    recording = open_recording(file)
    if not recording.complete:
        typer.echo(f"{file}: truncated; exporting the messages before the end", err=True)
    exported = exporter.export(recording, out or file.with_name(file.stem + exporter.suffix))
    if json:
        typer.echo(json_text(exported))
        return
    for table, count in exported.written.items():
        typer.echo(f"{count:>9}  {table}")
    for key, count in exported.unreadable.items():
        typer.echo(f"{count:>9}  invalid messages of {key} were left out")
    for key, count in exported.omitted.items():
        typer.echo(f"{count:>9}  messages of {key} have no place in this format")
    typer.echo(str(exported.out))
