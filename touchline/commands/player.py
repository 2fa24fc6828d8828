"""`touchline player`: controls a running replay: pause, resume, seek, rate."""

import json as json_text
from typing import Annotated

import typer

from schemas.access.accounts import Account
from schemas.bus.settings import ClientSettings
from schemas.errors import MatchFailedError, TouchlineError
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest
from touchline.cli import options
from touchline.cli.option_groups import with_option_groups


@with_option_groups
def player(
    operation: Annotated[ReplayOperation, typer.Argument(help="The operation.")] = ReplayOperation.STATUS,
    value: Annotated[
        str | None,
        typer.Argument(help="seek: seconds, an event, or an offset (+5, -5); rate: a number, or fast; step: ticks."),
    ] = None,
    *,
    connection: ClientSettings,
    json: options.Json = False,
) -> None:
    """Control a running replay, local or remote.

    Example: touchline player seek goal:1-5
    """
    from schemas.bus.contract import NoReplyError
    from schemas.topics import REPLAY_CONTROL
    from schemas.wire.message import BadMessageError
    from touchline.cli.bus_client import PATIENCE, bus_client
    from touchline.replay.progress import status_text

    request = request_of(operation, value)
    with bus_client(connection, Account.OPERATOR) as bus:
        try:
            reply: ReplayReply = bus.query(REPLAY_CONTROL, request, PATIENCE).result(PATIENCE)
        except (NoReplyError, BadMessageError) as error:
            raise TouchlineError(f'match "{bus.match}": {error}; no replay of that name runs there') from None
    if not reply.accepted:
        raise MatchFailedError(f"refused: {reply.reason}")
    typer.echo(json_text.dumps(reply.model_dump(exclude={"version", "reason"})) if json else status_text(reply))


def request_of(operation: ReplayOperation, value: str | None) -> ReplayRequest:
    """The request for an operation and its value.

    Raises:
        TouchlineError: the value is missing, unexpected or of the wrong type.
    """
    wanted = {ReplayOperation.SEEK: "seconds or an event", ReplayOperation.RATE: "a number or fast"}
    if value is None:
        if operation in wanted:
            raise TouchlineError(f"{operation.value} needs a value: {wanted[operation]}")
        return ReplayRequest(operation=operation)
    try:
        match operation:
            case ReplayOperation.SEEK if value[0] in "+-":
                return ReplayRequest(operation=operation, by=float(value))
            case ReplayOperation.SEEK:
                return ReplayRequest(operation=operation, to=value)
            case ReplayOperation.RATE:
                return ReplayRequest(operation=operation, rate=None if value == "fast" else float(value))
            case ReplayOperation.STEP:
                return ReplayRequest(operation=operation, ticks=int(value))
    except ValueError:
        raise TouchlineError(
            f'{operation.value} "{value}": give {wanted.get(operation, "a number of ticks")}'
        ) from None
    raise TouchlineError(f'{operation.value} takes no value, and "{value}" was given')
