"""`touchline recorder`: controls a running recorder: pause, resume, split, snapshot, status."""

import json as json_text
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated

import typer

from schemas.access.accounts import Account
from schemas.bus.settings import ClientSettings
from schemas.messages.recorder import RecorderOperation
from touchline.cli import options
from touchline.cli.errors import PREFIX
from touchline.cli.option_groups import with_option_groups
from touchline.commands import admit

app = typer.Typer(
    help="Control a recorder while it records: pause, resume, split, snapshot, status.\n\n"
    "Example: touchline recorder pause --name recorder",
    no_args_is_help=True,
)

COMMANDS: dict[RecorderOperation, tuple[str, str]] = {
    RecorderOperation.STATUS: ("Print the state of the recorder.", "--match friendly"),
    RecorderOperation.PAUSE: ("Stop recording messages; the file counts those left out.", ""),
    RecorderOperation.RESUME: ("Resume recording.", ""),
    RecorderOperation.SPLIT: ("Finish the current file and continue in the next one.", ""),
    RecorderOperation.SNAPSHOT: (
        "Write the last seconds to a file; the recorder must run with --snapshot.",
        "--match friendly",
    ),
}
"""Operation, which is also the command's name → its help, and the options of its example."""

app.command("admit")(admit.recorder)

_ANSWER_S = 5.0
"""Wall time to wait for a recorder's reply, s; a snapshot is written before the reply."""


@dataclass(frozen=True)
class RecorderChoice:
    """Which recorder to control, and how to print its reply."""

    name: Annotated[str, typer.Option(help="The recorder's name.")] = "recorder"
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
    """Send the request and print the reply; exit status 1 if it is a refusal."""
    from schemas.bus.contract import NoReplyError
    from schemas.errors import MatchFailedError
    from schemas.messages.recorder import RecorderReply, RecorderRequest
    from schemas.topics import RECORDER_CONTROL
    from touchline.cli.bus_client import bus_client

    with bus_client(connection, Account.OPERATOR) as bus:
        try:
            answer = bus.query(RECORDER_CONTROL, RecorderRequest(operation=operation), _ANSWER_S, name=chosen.name)
            reply: RecorderReply = answer.result(_ANSWER_S + 0.5)
        except NoReplyError as error:
            raise MatchFailedError(
                f"no recorder named {chosen.name} answers ({error}); name another one with --name"
            ) from None
    if chosen.json:
        typer.echo(json_text.dumps(reply.model_dump(mode="json", exclude={"version"})))
    elif reply.accepted:
        doing = "paused" if reply.paused else "recording"
        typer.echo(f"{reply.recorder}: {doing}, {reply.messages} messages, {reply.lost} lost, {reply.file}")
    if not reply.accepted:
        typer.echo(f"{PREFIX}{reply.recorder} refused: {reply.reason}", err=True)
        raise typer.Exit(1)
