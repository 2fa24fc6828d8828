"""`touchline record`: records a running match, on this machine or another."""

from pathlib import Path
from typing import Annotated

import typer

from touchline.cli import options
from touchline.cli.option_groups import expand_option_groups
from touchline.cli.record_options import RecordOptions


@expand_option_groups
def record(
    out: Annotated[Path, typer.Option(help="The file, *.mcap.")],
    name: Annotated[str, typer.Option(help="What this recorder is called; two of one match differ.")] = "recorder",
    *,
    recording: RecordOptions,
    connection: options.ConnectOptions,
) -> None:
    """Record a match until its host leaves, or until Ctrl-C.

    With --split-size, --split-duration or --snapshot the files are numbered: final.0001.mcap, final.0002.mcap.
    Each is whole in itself. `touchline recorder` controls it meanwhile.

    Example: touchline record --connect tcp/192.168.1.5:7447 --out final.mcap --split-duration 300 --keep 4
    """
    from recordings.__main__ import main

    place = ["--connect", connection.connect, "--match", connection.match, "--out", str(out), "--name", name]
    raise typer.Exit(main([*place, *recording.arguments()]))
