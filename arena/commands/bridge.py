"""`touchline coach bridge`: the match for coach programs, for a league's referee box, and for team software."""

from pathlib import Path
from typing import Annotated

import typer

from arena import options
from coach_gateway.refbox.framing import Protocol
from coach_gateway.web.settings import LOOPBACK
from schemas.errors import TouchlineError
from schemas.side import Side

Words = list[str] | None


def bridge(
    connect: options.Connect = options.DEFAULT_ENDPOINT,
    match: options.Match = options.DEFAULT_MATCH,
    udp: Annotated[int | None, typer.Option(help="Hear coach programs on this UDP port; 0 takes a free one.")] = None,
    tokens: Annotated[
        Path | None,
        typer.Option(envvar="TOUCHLINE_TOKENS", help="File of the tokens, made when it is not there."),
    ] = None,
    refbox: Annotated[
        str | None, typer.Option(metavar="HOST[:PORT]", help="Be a base station at a league's referee box.")
    ] = None,
    team: Annotated[list[Side] | None, typer.Option(help="Whose base station; may be given twice.")] = None,
    refbox_protocol: Annotated[
        Protocol, typer.Option(help="How that box speaks; auto: as its first bytes show.")
    ] = Protocol.AUTO,
    refbox_server: Annotated[
        Words, typer.Option(metavar="[SIDE:]PORT", help="Be a referee box for team software; the league's is 28097.")
    ] = None,
    audience: Annotated[Words, typer.Option(metavar="HOST:PORT", help="Send the audience feed there.")] = None,
    listen: Annotated[
        str, typer.Option(help="Address that programs and base stations come to; 0.0.0.0 lets other machines in.")
    ] = LOOPBACK,
) -> None:
    """Join coach programs, a league's referee box or team software to a running match, until Ctrl-C.

    While a referee box officiates, everybody else may only stop the game; the match should have the referee `manual`.

    Example: touchline coach bridge --refbox 192.168.1.2 --team cyan
    """
    from coach_gateway.__main__ import serve
    from coach_gateway.bridges import bridges_of

    wanted = bridges_of(
        udp=udp,
        refbox_at=refbox,
        teams=team or [],
        protocol=refbox_protocol,
        doors=refbox_server or [],
        audience=audience or [],
        listen=listen,
    )
    if not wanted.wanted:
        raise TouchlineError("no bridge is named; name --udp, --refbox, --refbox-server or --audience")
    serve(connect, match, None, wanted, tokens)
