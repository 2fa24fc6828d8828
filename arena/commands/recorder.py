"""`touchline recorder`: pause, resume, split, snapshot and status of a recorder that is running."""

import json as json_text
from typing import Annotated

import typer

from arena import options
from arena.front import PREFIX

app = typer.Typer(
    help="Control a recorder while it records: pause, resume, split, snapshot, status.\n\n"
    "Example: touchline recorder pause --name recorder",
    no_args_is_help=True,
)

Name = Annotated[str, typer.Option(help="What the recorder is called.")]
_ANSWER_S = 5.0
"""s of wall time that a recorder is given to answer; a snapshot has to be written first."""


@app.command()
def status(
    connect: options.Connect = options.DEFAULT_ENDPOINT,
    match: options.Match = options.DEFAULT_MATCH,
    name: Name = "recorder",
    json: options.Json = False,
) -> None:
    """Say how the recorder is doing.

    Example: touchline recorder status --match friendly
    """
    _ask("status", connect, match, name, json=json)


@app.command()
def pause(
    connect: options.Connect = options.DEFAULT_ENDPOINT,
    match: options.Match = options.DEFAULT_MATCH,
    name: Name = "recorder",
    json: options.Json = False,
) -> None:
    """Leave out what comes from now on; it is counted in the file.

    Example: touchline recorder pause
    """
    _ask("pause", connect, match, name, json=json)


@app.command()
def resume(
    connect: options.Connect = options.DEFAULT_ENDPOINT,
    match: options.Match = options.DEFAULT_MATCH,
    name: Name = "recorder",
    json: options.Json = False,
) -> None:
    """Record again.

    Example: touchline recorder resume
    """
    _ask("resume", connect, match, name, json=json)


@app.command()
def split(
    connect: options.Connect = options.DEFAULT_ENDPOINT,
    match: options.Match = options.DEFAULT_MATCH,
    name: Name = "recorder",
    json: options.Json = False,
) -> None:
    """Finish the file that is being written, and go on in the next one.

    Example: touchline recorder split
    """
    _ask("split", connect, match, name, json=json)


@app.command()
def snapshot(
    connect: options.Connect = options.DEFAULT_ENDPOINT,
    match: options.Match = options.DEFAULT_MATCH,
    name: Name = "recorder",
    json: options.Json = False,
) -> None:
    """Have a recorder that was started with --snapshot write the last seconds to a file.

    Example: touchline recorder snapshot --match friendly
    """
    _ask("snapshot", connect, match, name, json=json)


def _ask(deed: str, connect: str, match: str, name: str, *, json: bool) -> None:
    """Ask, print the answer; exit status 1 where it is a refusal."""
    from arena.seat import seat
    from schemas.bus.contract import NoAnswerError
    from schemas.control import RecorderDeed, RecorderReply, RecorderRequest
    from schemas.errors import MatchFailedError
    from schemas.topics import CONTROL

    with seat(connect, match) as bus:
        try:
            answer = bus.ask(CONTROL, RecorderRequest(deed=RecorderDeed(deed)), _ANSWER_S, name=name)
            reply: RecorderReply = answer.result(_ANSWER_S + 0.5)
        except NoAnswerError as error:
            raise MatchFailedError(
                f"no recorder named {name} answers ({error}); --name says which one is meant"
            ) from None
    if json:
        typer.echo(json_text.dumps(reply.model_dump(mode="json", exclude={"version"})))
    elif reply.accepted:
        doing = "paused" if reply.paused else "recording"
        typer.echo(f"{reply.recorder}: {doing}, {reply.messages} messages, {reply.lost} lost, {reply.file}")
    if not reply.accepted:
        typer.echo(f"{PREFIX}{reply.recorder} refused: {reply.reason}", err=True)
        raise typer.Exit(1)
