"""`touchline coach bridge`: the match for coach programs, for a league's referee box, and for team software."""

from typing import Annotated, Any

import typer

from coach_gateway import run
from coach_gateway.settings import BridgeOptions, GatewaySettings
from runtime.bus.settings import ClientSettings
from runtime.bus.without_host import WithoutHost
from schemas.errors import TouchlineError
from touchline.commands.cli.option_groups import FieldsOf, with_option_groups


@with_option_groups
def bridge(
    bridges: BridgeOptions,
    joined: ClientSettings,
    alone: WithoutHost,
    more: Annotated[dict[str, Any], FieldsOf(GatewaySettings, "tokens", "log_format")],
) -> None:
    """Join coach programs, a league's referee box or team software to a running match, until Ctrl-C.

    While a league's box is connected, other clients may only stop the game. Run the match with a `manual` referee. With
    --match-file it is the game of robots on hardware, without a host.

    Example: touchline coach bridge --refbox 192.168.1.2 --team cyan
    """
    if not bridges.wanted and alone.match_file is None:
        raise TouchlineError("no bridge is named; name --udp, --refbox, --refbox-server or --audience")
    settings = GatewaySettings(**joined.model_dump(), bridges=bridges, alone=alone, **more)
    raise typer.Exit(run(settings))
