"""`touchline watch`: a running match, or a replay, drawn in the terminal."""

import sys
from typing import TYPE_CHECKING

import typer

from arena import options
from arena.bundle import unbundled
from arena.seat import PATIENCE
from arena.seat import seat as _seat

if TYPE_CHECKING:
    from rich.console import Console

    from schemas.bus.contract import Bus

_EVERY = 0.1
"""s of wall time between two pictures."""


@unbundled
def watch(seat: options.Seat) -> None:
    """Watch a match in the terminal until its host goes, or until Ctrl-C: pitch, score, robots, events.

    Where the output is no terminal, the match is told in plain lines. A replay is watched in the same way.

    Example: touchline watch --match friendly
    """
    if not sys.stdout.isatty():
        from coach_gateway.__main__ import run

        run(seat.connect, seat.match, PATIENCE)
        return
    from arena.console import console

    with _seat(seat.connect, seat.match) as bus:
        try:
            watch_on(bus, console())
        except KeyboardInterrupt:
            return
    typer.echo("the host is gone", err=True)


def watch_on(bus: "Bus", console: "Console") -> None:
    """Draw until the host goes; the last picture stays, where the terminal was.

    Raises:
        TouchlineError: no host plays this match.
    """
    from rich.console import Group
    from rich.live import Live

    from arena.watch.picture import picture
    from coach_gateway.closeup import Closeup
    from coach_gateway.gateway import Gateway
    from coach_gateway.presence import HostPresence

    gateway, host = Gateway(bus, PATIENCE), HostPresence(bus)
    setup = gateway.setup()
    host.wait(PATIENCE)
    bus.declare_alive("coach", "watch")
    seen, episode = Closeup(bus), 0
    last = Group()
    try:
        with Live(console=console, auto_refresh=False, screen=True) as live:
            going = True
            while going:
                going = not host.gone()  # looked at first, so that the last messages are still seen
                seen.update()
                if going and seen.world is not None and seen.world.episode != episode:
                    setup, episode = gateway.setup(), seen.world.episode  # others may take part
                last = Group(*picture(seen, setup, console.width, console.height - 1))
                live.update(last, refresh=True)
                bus.clock.sleep_until(bus.clock.now() + _EVERY)
    finally:
        console.print(last)
