"""`touchline pace`: pauses a running match, steps it, and lets it run."""

from typing import Annotated

import typer

from runtime.bus.settings import ClientSettings
from schemas.messages.pace import PaceOperation, PaceReply, PaceRequest
from schemas.topics import PACE
from touchline.commands.cli.bus_client import ask_host
from touchline.commands.cli.option_groups import with_option_groups


@with_option_groups
def pace(
    operation: Annotated[PaceOperation, typer.Argument(help="What to do; a step pauses again.")] = PaceOperation.SHOW,
    ticks: Annotated[int, typer.Argument(min=1, max=1_000_000_000, help="Length of a step.")] = 1,
    *,
    connection: ClientSettings,
) -> None:
    """Pause a running match, step it tick by tick, or let it run; robots and clocks of the match wait meanwhile.

    The match stays the one that it would have been. A replay is paused by the keys of touchline replay, or on the page.

    Example: touchline pace pause

    Example: touchline pace step 50
    """
    reply: PaceReply = ask_host(connection, PACE, PaceRequest(operation=operation, ticks=ticks))
    state = "paused" if reply.paused else f"pauses at tick {reply.until}" if reply.until is not None else "runs"
    typer.echo(f"tick {reply.tick}: {state}")
