"""`touchline host`: the simulation alone, for robots and recorders on other machines."""

from typing import Annotated, Any

import typer

from sim_host import run
from sim_host.server.settings import HostSettings
from touchline.cli import options
from touchline.cli.option_groups import FieldsOf, with_option_groups


@with_option_groups
def host(
    match: options.MatchOptions,
    more: Annotated[dict[str, Any], FieldsOf(HostSettings, "outcome", "launch_token", "announcement", "log_format")],
) -> None:
    """Run the simulation host of a match; robots join with `touchline agent`.

    The host ends when the match is over, or at Ctrl-C.

    Example: touchline host cup.toml --pace realtime --listen tcp/192.168.1.5:7447 --credentials credentials/host.json
    """
    config = match.read()
    match.endpoint()  # checked before the host is loaded
    settings = HostSettings(config=config, **match.listening.model_dump(), **more)
    raise typer.Exit(run(settings))
