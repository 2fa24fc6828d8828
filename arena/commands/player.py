"""`touchline player`: a running replay is told to go on, stop, or go elsewhere."""

import json as json_text
from typing import Annotated

import typer

from arena import options
from arena.bundle import unbundled
from schemas.errors import MatchFailedError, TouchlineError
from schemas.replay import ReplayDeed, ReplayReply, ReplayRequest


@unbundled
def player(
    deed: Annotated[ReplayDeed, typer.Argument(help="What to do.")] = ReplayDeed.STATUS,
    value: Annotated[
        str | None,
        typer.Argument(help="seek: seconds or an event, or +5 and -5 from here; rate: a number, or fast; step: ticks."),
    ] = None,
    *,
    seat: options.Seat,
    json: options.Json = False,
) -> None:
    """Control a running replay, on this machine or another.

    Example: touchline player seek goal:1-5
    """
    from arena.replay_screen import words
    from arena.seat import PATIENCE
    from arena.seat import seat as _seat
    from schemas.bus.contract import NoAnswerError
    from schemas.message import BadMessageError
    from schemas.topics import REPLAY

    request = request_of(deed, value)
    with _seat(seat.connect, seat.match) as bus:
        try:
            reply: ReplayReply = bus.ask(REPLAY, request, PATIENCE).result(PATIENCE)
        except (NoAnswerError, BadMessageError) as error:
            raise TouchlineError(f'match "{seat.match}": {error}; no replay of that name runs there') from None
    if not reply.accepted:
        raise MatchFailedError(f"refused: {reply.reason}")
    typer.echo(json_text.dumps(reply.model_dump(exclude={"version", "reason"})) if json else words(reply))


def request_of(deed: ReplayDeed, value: str | None) -> ReplayRequest:
    """What is asked for by a deed and its value.

    Raises:
        TouchlineError: a value that is missing, surplus or of the wrong kind.
    """
    wanted = {ReplayDeed.SEEK: "seconds or an event", ReplayDeed.RATE: "a number or fast"}
    if value is None:
        if deed in wanted:
            raise TouchlineError(f"{deed.value} needs a value: {wanted[deed]}")
        return ReplayRequest(deed=deed)
    try:
        match deed:
            case ReplayDeed.SEEK if value[0] in "+-":
                return ReplayRequest(deed=deed, by=float(value))
            case ReplayDeed.SEEK:
                return ReplayRequest(deed=deed, to=value)
            case ReplayDeed.RATE:
                return ReplayRequest(deed=deed, rate=None if value == "fast" else float(value))
            case ReplayDeed.STEP:
                return ReplayRequest(deed=deed, ticks=int(value))
    except ValueError:
        raise TouchlineError(f'{deed.value} "{value}": give {wanted.get(deed, "a number of ticks")}') from None
    raise TouchlineError(f'{deed.value} takes no value, and "{value}" was given')
