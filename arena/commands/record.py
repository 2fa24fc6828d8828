"""`touchline record`: records a running match, on this machine or another."""

from pathlib import Path
from typing import Annotated

import typer

from arena import options


def record(
    out: Annotated[Path, typer.Option(help="The file, *.mcap.")],
    connect: options.Connect = options.DEFAULT_ENDPOINT,
    match: options.Match = options.DEFAULT_MATCH,
    name: Annotated[str, typer.Option(help="What this recorder is called; two of one match differ.")] = "recorder",
    sights: options.Sights = False,
) -> None:
    """Record a match until its host leaves, or until Ctrl-C.

    Example: touchline record --connect tcp/192.168.1.5:7447 --out final.mcap
    """
    from recordings.__main__ import main

    more = ["--sights"] if sights else []
    raise typer.Exit(main(["--connect", connect, "--match", match, "--out", str(out), "--name", name, *more]))
