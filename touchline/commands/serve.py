"""`touchline coach serve`: the match's page, for people who watch and command it in their browsers."""

from pathlib import Path
from typing import Annotated

import typer

from coach_gateway.ports import LOOPBACK
from coach_gateway.web.settings import (
    DEFAULT_PAGES,
    DEFAULT_PAGES_EACH,
    DEFAULT_PORT,
    BeliefsFor,
    WebSettings,
)
from touchline.cli import options
from touchline.cli.bridge_options import BridgeOptions
from touchline.cli.option_groups import expand_option_groups


@expand_option_groups
def serve(
    bridges: BridgeOptions,
    connection: options.ConnectOptions,
    port: Annotated[int, typer.Option(help="Port of the page; 0 takes a free one.")] = DEFAULT_PORT,
    listen_web: options.ListenWeb = LOOPBACK,
    tokens: Annotated[
        Path | None,
        typer.Option(
            envvar="TOUCHLINE_TOKENS",
            help="File of the tokens, made when it is not there; without one they last as long as the page is served.",
        ),
    ] = None,
    allow_origin: Annotated[
        list[str] | None, typer.Option(help="A further origin that the page may come from: https://cup.example.org.")
    ] = None,
    beliefs: Annotated[
        BeliefsFor | None,
        typer.Option(help="Who is shown what robots believe; by default all in a friendly, else each team its own."),
    ] = None,
    pages: Annotated[int, typer.Option(min=1, help="How many pages may be open at once.")] = DEFAULT_PAGES,
    pages_per_address: Annotated[
        int, typer.Option(min=1, help="How many of them from one other address; this machine's own are not counted.")
    ] = DEFAULT_PAGES_EACH,
) -> None:
    """Serve the page of a running match, or of a replay, until Ctrl-C; hosts may come and go meanwhile.

    It says where the page is, with a token for the referee and for each side's coach. Bridges go on beside it, as
    `touchline coach bridge` has them.

    Example: touchline coach serve --port 8081
    """
    from coach_gateway.__main__ import serve as serve_page

    web = WebSettings(port, listen_web, tokens, tuple(allow_origin or ()), beliefs, pages, pages_per_address)
    serve_page(connection.connect, connection.match, web, bridges.bridges())
