"""`touchline record`: records a running match, local or remote."""

import typer

from recordings import run
from recordings.recorder.settings import RecorderSettings
from touchline.cli.option_groups import with_option_groups


@with_option_groups
def record(settings: RecorderSettings) -> None:
    """Record a match until its host ends, or until Ctrl-C.

    With --split-size or --split-duration the files are numbered: final.0001.mcap, final.0002.mcap.
    Each file is a complete recording.

    Example: touchline record --connect tcp/192.168.1.5:7447 --out final.mcap --split-duration 300
    """
    raise typer.Exit(run(settings))
