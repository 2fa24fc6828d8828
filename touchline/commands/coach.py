"""`touchline coach`: the coach's bench of a running match, and what serves it to people and programs."""

import typer

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.host_client import HostClient
from runtime.access.accounts import Account
from runtime.bus.settings import ClientSettings
from runtime.process.timing import REQUEST_S
from schemas.errors import MatchFailedError, TouchlineError
from schemas.wire.part import encode
from touchline.commands import orders
from touchline.commands.bridge import bridge
from touchline.commands.cli import options
from touchline.commands.cli.bus_client import bus_client
from touchline.commands.cli.option_groups import with_option_groups
from touchline.commands.serve import serve

app = typer.Typer(
    no_args_is_help=True,
    help="Order a side of a running match, print its state, or serve it to browsers and programs.\n\n"
    "Example: touchline coach order cyan --mode hold",
)
app.command("order")(orders.order)
app.command("test")(orders.test)
app.command("serve")(serve)
app.command("bridge")(bridge)


@app.command("state")
@with_option_groups
def state(connection: ClientSettings, json: options.Json = False) -> None:
    """Print the current state of the match once.

    Example: touchline coach state --json | jq .score
    """
    from coach_gateway.match.lines import state_line

    with bus_client(connection, Account.REFEREE) as bus:
        follower = MatchFollower(bus)
        found = follower.wait_for_state(REQUEST_S)
        names = HostClient(bus).team_names()
    if found is None and follower.health is not None:
        there = sum(robot.alive for robot in follower.health.robots.values())
        raise MatchFailedError(
            f'match "{bus.match}" has not begun: {there} of {len(follower.health.robots)} robots are connected'
        )
    if found is None:
        raise TouchlineError(f'match "{bus.match}": the host publishes no state of it; is that the name of its match?')
    typer.echo(encode(found.plain("version")).decode() if json else state_line(found, names))
