"""`touchline coach serve`: serves the match's page, to watch and command the match in a browser."""

import typer

from coach_gateway import run
from coach_gateway.settings import GatewaySettings
from touchline.commands.cli.option_groups import with_option_groups


@with_option_groups
def serve(settings: GatewaySettings) -> None:
    """Serve the page of a running match, or of a replay, until Ctrl-C; hosts may restart meanwhile.

    Prints the page's address, with a token for the referee and for each side's coach. Bridges run in the same
    process, as with `touchline coach bridge`.

    Example: touchline coach serve --port 8081
    """
    raise typer.Exit(run(settings))
