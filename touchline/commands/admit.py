"""`touchline referee admit` and `touchline referee admit-recorder`: whom the host admits while a match runs."""

from typing import Annotated, Any

import typer

from schemas.access.accounts import Account
from schemas.bus.contract import NoReplyError
from schemas.bus.settings import ClientSettings
from schemas.errors import MatchFailedError
from schemas.messages.admission import AdmissionReply, AdmissionRequest
from schemas.topics import ADMISSION
from touchline.cli.bus_client import bus_client
from touchline.cli.option_groups import from_options, with_option_groups

_REPLY_S = 5.0


@with_option_groups
def account(
    connection: ClientSettings,
    account: Annotated[
        str | None,
        typer.Argument(help="The account, or on a host without credentials its key; none lists all that are cut off."),
    ] = None,
) -> None:
    """Read the messages of an account again that was cut off for going on above its limit.

    Example: touchline referee admit cyan
    """
    cut_off = _request(connection, account=account).cut_off
    if account is not None:
        typer.echo(f"{account} is admitted again")
    typer.echo(f"cut off: {', '.join(cut_off)}" if cut_off else "no account is cut off")


@with_option_groups
def recorder(
    connection: ClientSettings, name: Annotated[str, typer.Option(help="The recorder's name.")] = "recorder"
) -> None:
    """Let a lockstep host wait for a recorder that falls behind; others lose what the host no longer keeps.

    Example: touchline referee admit-recorder --name tape
    """
    _request(connection, recorder=name)
    typer.echo(f"the host waits for {name}")


def _request(connection: ClientSettings, **wanted: Any) -> AdmissionReply:
    request = from_options(AdmissionRequest, **wanted)
    with bus_client(connection, Account.REFEREE) as bus:
        try:
            reply: AdmissionReply = bus.query(ADMISSION, request, _REPLY_S).result(_REPLY_S + 0.5)
        except NoReplyError as error:
            raise MatchFailedError(f'the host of "{bus.match}" does not answer ({error})') from None
    if not reply.accepted:
        raise MatchFailedError(f"refused: {reply.reason}")
    return reply
