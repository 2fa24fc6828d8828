"""`touchline record`: records a running match, on this machine or another."""

import typer

from recordings import run
from recordings.recorder.settings import RecorderSettings
from touchline.cli.option_groups import with_option_groups


@with_option_groups
def record(settings: RecorderSettings) -> None:
    """Record a match until its host leaves, or until Ctrl-C.

    With --split-size, --split-duration or --snapshot the files are numbered: final.0001.mcap, final.0002.mcap.
    Each is whole in itself. `touchline recorder` controls it meanwhile.

    Example: touchline record --connect tcp/192.168.1.5:7447 --out final.mcap --split-duration 300 --keep 4
    """
    raise typer.Exit(run(settings))
