"""`touchline referee admit-recorder`: the recorders that the host waits for."""

from typing import Annotated

import typer

from schemas.access.accounts import Account
from schemas.bus.contract import NoReplyError
from schemas.bus.settings import ClientSettings
from schemas.errors import MatchFailedError
from schemas.messages.admission import AdmissionRequest
from schemas.topics import ADMISSION
from touchline.cli.bus_client import bus_client
from touchline.cli.option_groups import from_options, with_option_groups
from touchline.timing import HOST_S


@with_option_groups
def recorder(
    connection: ClientSettings, name: Annotated[str, typer.Option(help="The recorder's name.")] = "recorder"
) -> None:
    """Let a lockstep host wait for a recorder that falls behind; others lose what the host no longer keeps.

    Example: touchline referee admit-recorder --name tape
    """
    request = from_options(AdmissionRequest, recorder=name)
    with bus_client(connection, Account.REFEREE) as bus:
        try:
            bus.query(ADMISSION, request, HOST_S).result(HOST_S + 0.5)
        except NoReplyError as error:
            raise MatchFailedError(f'the host of "{bus.match}" does not answer ({error})') from None
    typer.echo(f"the host waits for {name}")
