"""`touchline watch`: a running match, or a replay, drawn in the terminal."""

import sys
from typing import TYPE_CHECKING

import typer

from coach_gateway import run
from coach_gateway.settings import GatewaySettings
from schemas.access.accounts import Account
from schemas.bus.settings import ClientSettings
from touchline.cli.bus_client import PATIENCE, bus_client
from touchline.cli.option_groups import with_option_groups

if TYPE_CHECKING:
    from rich.console import Console

    from schemas.bus.contract import Bus

_EVERY = 0.1
"""Wall time between two pictures, s."""


@with_option_groups
def watch(connection: ClientSettings) -> None:
    """Watch a match in the terminal until its host ends, or until Ctrl-C: pitch, score, robots, events.

    If the output is not a terminal, the match is printed as plain lines. Replays can be watched, too.

    Example: touchline watch --match friendly
    """
    if not sys.stdout.isatty():
        raise typer.Exit(run(GatewaySettings(**connection.model_dump())))
    from touchline.cli.console import console

    with bus_client(connection, Account.OPERATOR) as bus:
        try:
            watch_on(bus, console())
        except KeyboardInterrupt:
            return
    typer.echo("the host is gone", err=True)


def watch_on(bus: "Bus", console: "Console") -> None:
    """Draw until the host ends; the last picture stays on the terminal.

    Raises:
        TouchlineError: no host plays this match.
    """
    from rich.console import Group
    from rich.live import Live

    from coach_gateway.match.follower import MatchFollower
    from coach_gateway.match.host_client import HostClient
    from schemas.bus.contract import PresenceKind
    from touchline.watch.drawing import draw_match

    client, seen = HostClient(bus, PATIENCE), MatchFollower(bus, details=True)
    setup, episode = client.setup(), 0
    seen.host.wait(PATIENCE)
    bus.declare_alive(PresenceKind.COACH, "watch")
    last = Group()
    try:
        with Live(console=console, auto_refresh=False, screen=True) as live:
            going = True
            while going:
                seen.update()
                going = not seen.gone
                if going and seen.world is not None and seen.world.episode != episode:
                    setup, episode = client.setup(), seen.world.episode  # others may take part
                last = Group(*draw_match(seen, setup, console.width, console.height - 1))
                live.update(last, refresh=True)
                bus.clock.sleep_until(bus.clock.now() + _EVERY)
    finally:
        console.print(last)
