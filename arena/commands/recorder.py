"""`touchline recorder`: pause, resume, split, snapshot and status of a recorder that is running."""

import json as json_text
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated

import typer

from arena import options
from arena.bundle import unbundled
from arena.front import PREFIX
from schemas.control import RecorderDeed

app = typer.Typer(
    help="Control a recorder while it records: pause, resume, split, snapshot, status.\n\n"
    "Example: touchline recorder pause --name recorder",
    no_args_is_help=True,
)

DEEDS: dict[RecorderDeed, tuple[str, str]] = {
    RecorderDeed.STATUS: ("Say how the recorder is doing.", "--match friendly"),
    RecorderDeed.PAUSE: ("Leave out what comes from now on; it is counted in the file.", ""),
    RecorderDeed.RESUME: ("Record again.", ""),
    RecorderDeed.SPLIT: ("Finish the file that is being written, and go on in the next one.", ""),
    RecorderDeed.SNAPSHOT: (
        "Have a recorder that was started with --snapshot write the last seconds to a file.",
        "--match friendly",
    ),
}
"""Deed, which is also the word of its command → its help, and the options of its example."""

_ANSWER_S = 5.0
"""s of wall time that a recorder is given to answer; a snapshot has to be written first."""


@dataclass(frozen=True)
class Asking:
    """Which recorder is meant, and how its answer is shown."""

    name: Annotated[str, typer.Option(help="What the recorder is called.")] = "recorder"
    json: options.Json = False


def _command(deed: RecorderDeed) -> Callable[..., None]:
    def command(seat: options.Seat, asking: Asking) -> None:
        _ask(deed, seat, asking)

    return unbundled(command)


for _deed, (_help, _words) in DEEDS.items():
    app.command(_deed.value, help=f"{_help}\n\nExample: touchline recorder {_deed.value} {_words}".rstrip())(
        _command(_deed)
    )


def _ask(deed: RecorderDeed, seat: options.Seat, asking: Asking) -> None:
    """Ask, print the answer; exit status 1 where it is a refusal."""
    from arena.seat import seat as seat_of
    from schemas.bus.contract import NoAnswerError
    from schemas.control import RecorderReply, RecorderRequest
    from schemas.errors import MatchFailedError
    from schemas.topics import CONTROL

    with seat_of(seat.connect, seat.match) as bus:
        try:
            answer = bus.ask(CONTROL, RecorderRequest(deed=deed), _ANSWER_S, name=asking.name)
            reply: RecorderReply = answer.result(_ANSWER_S + 0.5)
        except NoAnswerError as error:
            raise MatchFailedError(
                f"no recorder named {asking.name} answers ({error}); --name says which one is meant"
            ) from None
    if asking.json:
        typer.echo(json_text.dumps(reply.model_dump(mode="json", exclude={"version"})))
    elif reply.accepted:
        doing = "paused" if reply.paused else "recording"
        typer.echo(f"{reply.recorder}: {doing}, {reply.messages} messages, {reply.lost} lost, {reply.file}")
    if not reply.accepted:
        typer.echo(f"{PREFIX}{reply.recorder} refused: {reply.reason}", err=True)
        raise typer.Exit(1)
