"""`touchline referee admit-recorder`: the recorders that the host waits for."""

from typing import Annotated

import typer

from coach_gateway.match.host_client import HostClient
from runtime.access.accounts import Account
from runtime.bus.settings import ClientSettings
from schemas.messages.admission import AdmissionRequest
from schemas.topics import ADMISSION
from touchline.commands.cli.bus_client import bus_client
from touchline.commands.cli.option_groups import from_options, with_option_groups


@with_option_groups
def recorder(
    connection: ClientSettings, name: Annotated[str, typer.Option(help="The recorder's name.")] = "recorder"
) -> None:
    """Let a lockstep host wait for a recorder that falls behind; others lose what the host no longer keeps.

    Example: touchline referee admit-recorder --name tape
    """
    request = from_options(AdmissionRequest, recorder=name)
    with bus_client(connection, Account.REFEREE) as bus:
        HostClient(bus).ask(ADMISSION, request)
    typer.echo(f"the host waits for {name}")
