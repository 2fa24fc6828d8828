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
    include: options.Include = None,
    exclude: options.Exclude = None,
    split_size: options.SplitSize = None,
    split_duration: options.SplitDuration = None,
    keep: options.Keep = None,
    snapshot: options.Snapshot = None,
    no_viz: options.NoViz = False,
) -> None:
    """Record a match until its host leaves, or until Ctrl-C.

    With --split-size, --split-duration or --snapshot the files are numbered: final.0001.mcap, final.0002.mcap.
    Each is whole in itself. `touchline recorder` controls it meanwhile.

    Example: touchline record --connect tcp/192.168.1.5:7447 --out final.mcap --split-duration 300 --keep 4
    """
    from recordings.__main__ import main

    values = {"split-size": split_size, "split-duration": split_duration, "keep": keep, "snapshot": snapshot}
    more = [word for word, wanted in (("--sights", sights), ("--no-viz", no_viz)) if wanted]
    more += [f"--include={expression}" for expression in include or ()]
    more += [f"--exclude={expression}" for expression in exclude or ()]
    more += [f"--{word}={value}" for word, value in values.items() if value is not None]
    raise typer.Exit(main(["--connect", connect, "--match", match, "--out", str(out), "--name", name, *more]))
