"""`touchline host`: the simulation alone, for robots and recorders on other machines."""

from typing import Annotated, Any

import typer

from runtime.bus.settings import check_protected
from schemas.config.match_parts import Patience
from sim_host import run
from sim_host.server.settings import HostSettings
from touchline.commands.cli import options
from touchline.commands.cli.option_groups import FieldsOf, from_options, with_option_groups


@with_option_groups
def host(
    match: options.MatchOptions,
    waiting: Annotated[dict[str, Any], FieldsOf(Patience, attendance="wait")],
    more: Annotated[
        dict[str, Any], FieldsOf(HostSettings, "outcome", "launch_token", "admit", "announcement", "log_format")
    ],
) -> None:
    """Run the simulation host of a match; robots join with `touchline agent` or `touchline team`.

    The match begins when all robots are there, after --wait seconds, or at `touchline referee start`. The host ends
    when the match is over, or at Ctrl-C.

    Example: touchline host cup.toml --pace realtime --listen tcp/192.168.1.5:7447 --credentials credentials/host.json
    """
    config = match.read(**{f"patience__{key}": value for key, value in waiting.items()})
    patience = config.patience
    if "attendance" not in patience.model_fields_set:  # people start the robots on other machines
        config = config.model_copy(update={"patience": patience.model_copy(update={"attendance": patience.remote})})
    check_protected(match.listening)  # checked before the host is loaded
    settings = from_options(HostSettings, config=config, **match.listening.model_dump(), **more)
    raise typer.Exit(run(settings))
