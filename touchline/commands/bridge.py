"""`touchline coach bridge`: the match for coach programs, for a league's referee box, and for team software."""

from pathlib import Path
from typing import Annotated

import typer

from schemas.errors import TouchlineError
from touchline.cli import options
from touchline.cli.bridge_options import BridgeOptions
from touchline.cli.option_groups import expand_option_groups


@expand_option_groups
def bridge(
    bridges: BridgeOptions,
    connection: options.ConnectOptions,
    tokens: Annotated[
        Path | None,
        typer.Option(
            envvar="TOUCHLINE_TOKENS",
            help="File of the coaches' tokens, made when it is not there; without one they last as long as this.",
        ),
    ] = None,
) -> None:
    """Join coach programs, a league's referee box or team software to a running match, until Ctrl-C.

    While a league's box is connected, everybody else may only stop the game; the match's referee is best `manual`.

    Example: touchline coach bridge --refbox 192.168.1.2 --team cyan
    """
    from coach_gateway.__main__ import serve

    chosen = bridges.bridges()
    if not chosen.wanted:
        raise TouchlineError("no bridge is named; name --udp, --refbox, --refbox-server or --audience")
    serve(connection.connect, connection.match, None, chosen, tokens)
