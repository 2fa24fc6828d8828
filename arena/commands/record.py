"""`touchline record`: records a running match, on this machine or another."""

from pathlib import Path
from typing import Annotated

import typer

from arena import options
from arena.bundle import unbundled
from arena.record_words import RecordWords


@unbundled
def record(
    out: Annotated[Path, typer.Option(help="The file, *.mcap.")],
    name: Annotated[str, typer.Option(help="What this recorder is called; two of one match differ.")] = "recorder",
    *,
    recording: RecordWords,
    seat: options.Seat,
) -> None:
    """Record a match until its host leaves, or until Ctrl-C.

    With --split-size, --split-duration or --snapshot the files are numbered: final.0001.mcap, final.0002.mcap.
    Each is whole in itself. `touchline recorder` controls it meanwhile.

    Example: touchline record --connect tcp/192.168.1.5:7447 --out final.mcap --split-duration 300 --keep 4
    """
    from recordings.__main__ import main

    place = ["--connect", seat.connect, "--match", seat.match, "--out", str(out), "--name", name]
    raise typer.Exit(main([*place, *recording.arguments()]))
