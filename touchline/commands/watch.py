"""`touchline watch`: a running match, or a replay, as a panel in the terminal."""

import sys
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, Annotated

import typer

from coach_gateway.match.debug_follower import DebugFollower
from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.host_client import HostClient
from runtime.access.accounts import Account
from runtime.bus.contract import Bus, PresenceKind
from runtime.bus.settings import ClientSettings
from runtime.process.timing import REQUEST_S
from schemas.errors import TouchlineError, did_you_mean
from schemas.messages.setup import Setup
from touchline.commands.cli.bus_client import bus_client
from touchline.commands.cli.option_groups import with_option_groups
from touchline.timing import REFRESH_S

if TYPE_CHECKING:
    from rich.console import Console


@with_option_groups
def watch(
    connection: ClientSettings,
    robot: Annotated[
        str | None, typer.Option(help="List the values that this robot's brain shows in `Command.debug`.")
    ] = None,
) -> None:
    """Watch a match in the terminal until its host ends, or until Ctrl-C: score, phase, robots, health, events.

    If the output is not a terminal, the match is printed as plain lines. Replays can be watched, too. The pitch is on
    the page: touchline match --web.

    Example: touchline watch --match friendly --robot cyan2
    """
    if not sys.stdout.isatty():
        if robot is not None:
            raise TouchlineError("--robot lists values on a terminal only; leave it out, or write to a terminal")
        with bus_client(connection) as bus, suppress(KeyboardInterrupt):
            watch_lines(bus, typer.echo)
        return
    from touchline.launch.terminal.console import console

    with bus_client(connection, Account.OPERATOR) as bus:
        try:
            watch_on(bus, console(), robot)
        except KeyboardInterrupt:
            return
    typer.echo("the host is gone", err=True)


def watch_lines(bus: Bus, log: Callable[[str], None]) -> None:
    """Log each event, and each state in which more has changed than its clock, until the host ends.

    Raises:
        TouchlineError: no host plays this match.
    """
    from coach_gateway.match.lines import event_line, state_line
    from coach_gateway.match.team_names import printable

    seen, before = MatchFollower(bus), None
    bus.declare_alive(PresenceKind.COACH, "watch")
    if not seen.host.wait(REQUEST_S):
        raise TouchlineError(f'match "{bus.match}": no host plays it there; name the match with --match')
    names = HostClient(bus, REQUEST_S).team_names()
    while not seen.gone:
        news = seen.update()
        for event in news.events:
            log(printable(event_line(event, names)))
        for state in news.states:
            asked = [(question.side, question.action) for question in state.questions]
            now = (state.phase, state.side, state.running, state.half, state.score, asked)
            if now != before:
                before = now
                log(printable(state_line(state, names)))
        bus.clock.sleep_until(bus.clock.now() + REFRESH_S)


def watch_on(bus: Bus, console: "Console", robot: str | None = None) -> None:
    """Show the panel until the host ends; its last state stays on the terminal. The values of `robot` are listed.

    Raises:
        TouchlineError: no host plays this match, or no such robot takes part.
    """
    from rich.console import Group
    from rich.live import Live

    from touchline.launch.terminal.panel import panel

    client, seen = HostClient(bus, REQUEST_S), MatchFollower(bus, details=True)
    drawings, host_changes = DebugFollower(bus), 0
    setup, episode = client.setup(), 0
    _check_robot(robot, setup)
    seen.host.wait(REQUEST_S)
    bus.declare_alive(PresenceKind.COACH, "watch")
    with Live(console=console, auto_refresh=False) as live:
        going = True
        while going:
            seen.update()
            drawings.update()
            if seen.host_changes != host_changes:
                host_changes = seen.host_changes
                drawings.clear()
            going = not seen.gone
            if going and seen.world is not None and seen.world.episode != episode:
                setup, episode = client.setup(), seen.world.episode  # others may take part
            drawn = drawings.shown(seen.world.time) if seen.world is not None else {}
            rows = panel(seen, setup, console.height - 1, drawn, robot)
            for row in rows:
                row.truncate(console.width, overflow="ellipsis")
            live.update(Group(*rows), refresh=True)
            bus.clock.sleep_until(bus.clock.now() + REFRESH_S)


def _check_robot(robot: str | None, setup: Setup) -> None:
    names = [name for team in setup.teams.values() for name in team.robots]
    if robot is not None and robot not in names:
        raise TouchlineError(f"--robot {robot}: no such robot takes part; {did_you_mean(robot, names)}")
