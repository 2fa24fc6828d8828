"""`touchline record`: records a running match, local or remote."""

import typer

from recordings import run
from recordings.recorder.settings import RecorderSettings
from touchline.commands.cli.option_groups import with_option_groups


@with_option_groups
def record(settings: RecorderSettings) -> None:
    """Record a match until its host ends, or until Ctrl-C.

    A recording that continues in another part, because of --part-size or --part-duration or because its recorder was
    killed and is started again, is final.mcap, final.2.mcap, final.3.mcap. Its first part stands for all of them.

    With --keys it records any keys of a Zenoh network, without a match: docs/any_mcap.md.

    Example: touchline record --connect tcp/192.168.1.5:7447 --out final.mcap --part-duration 300

    Example: touchline record --keys "robot/**" --connect tcp/192.168.1.5:7447 --out fleet.mcap
    """
    raise typer.Exit(run(settings))
