"""`touchline referee admit-recorder`: the recorders that the host waits for."""

from typing import Annotated

import typer

from runtime.access.accounts import Account
from runtime.bus.settings import ClientSettings
from schemas.messages.admission import AdmissionRequest
from schemas.topics import ADMISSION
from touchline.commands.cli.bus_client import ask_host
from touchline.commands.cli.option_groups import from_options, with_option_groups


@with_option_groups
def recorder(
    connection: ClientSettings, name: Annotated[str, typer.Option(help="The recorder's name.")] = "recorder"
) -> None:
    """Let a lockstep host wait for a recorder that falls behind; others lose what the host no longer keeps.

    Example: touchline referee admit-recorder --name tape
    """
    request = from_options(AdmissionRequest, recorder=name)
    ask_host(connection, ADMISSION, request, Account.REFEREE)
    typer.echo(f"the host waits for {name}")
