"""`touchline recorder`: pause, resume, split, snapshot and status of a recorder that is running."""

import json as json_text
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated

import typer

from schemas.bus.settings import ClientSettings
from schemas.messages.recorder import RecorderOperation
from touchline.cli import options
from touchline.cli.errors import PREFIX
from touchline.cli.option_groups import with_option_groups

app = typer.Typer(
    help="Control a recorder while it records: pause, resume, split, snapshot, status.\n\n"
    "Example: touchline recorder pause --name recorder",
    no_args_is_help=True,
)

COMMANDS: dict[RecorderOperation, tuple[str, str]] = {
    RecorderOperation.STATUS: ("Say how the recorder is doing.", "--match friendly"),
    RecorderOperation.PAUSE: ("Leave out what comes from now on; it is counted in the file.", ""),
    RecorderOperation.RESUME: ("Record again.", ""),
    RecorderOperation.SPLIT: ("Finish the file that is being written, and go on in the next one.", ""),
    RecorderOperation.SNAPSHOT: (
        "Have a recorder that was started with --snapshot write the last seconds to a file.",
        "--match friendly",
    ),
}
"""Deed, which is also the word of its command → its help, and the options of its example."""

_ANSWER_S = 5.0
"""s of wall time that a recorder is given to answer; a snapshot has to be written first."""


@dataclass(frozen=True)
class RecorderChoice:
    """Which recorder is meant, and how its answer is shown."""

    name: Annotated[str, typer.Option(help="What the recorder is called.")] = "recorder"
    json: options.Json = False


def _command(operation: RecorderOperation) -> Callable[..., None]:
    def command(connection: ClientSettings, chosen: RecorderChoice) -> None:
        _query(operation, connection, chosen)

    return with_option_groups(command)


for _operation, (_help, _example) in COMMANDS.items():
    app.command(
        _operation.value, help=f"{_help}\n\nExample: touchline recorder {_operation.value} {_example}".rstrip()
    )(_command(_operation))


def _query(operation: RecorderOperation, connection: ClientSettings, chosen: RecorderChoice) -> None:
    """Ask, print the answer; exit status 1 where it is a refusal."""
    from schemas.bus.contract import NoReplyError
    from schemas.errors import MatchFailedError
    from schemas.messages.recorder import RecorderReply, RecorderRequest
    from schemas.topics import RECORDER_CONTROL
    from touchline.cli.bus_client import bus_client

    with bus_client(connection.connect, connection.match) as bus:
        try:
            answer = bus.query(RECORDER_CONTROL, RecorderRequest(operation=operation), _ANSWER_S, name=chosen.name)
            reply: RecorderReply = answer.result(_ANSWER_S + 0.5)
        except NoReplyError as error:
            raise MatchFailedError(
                f"no recorder named {chosen.name} answers ({error}); --name says which one is meant"
            ) from None
    if chosen.json:
        typer.echo(json_text.dumps(reply.model_dump(mode="json", exclude={"version"})))
    elif reply.accepted:
        doing = "paused" if reply.paused else "recording"
        typer.echo(f"{reply.recorder}: {doing}, {reply.messages} messages, {reply.lost} lost, {reply.file}")
    if not reply.accepted:
        typer.echo(f"{PREFIX}{reply.recorder} refused: {reply.reason}", err=True)
        raise typer.Exit(1)
