"""`touchline drive`: one robot driven by keys, in place of its brain."""

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

import typer

from schemas.access.accounts import Account
from schemas.bus.settings import ClientSettings
from schemas.errors import MatchFailedError, TouchlineError, did_you_mean
from schemas.messages.manual import ManualDrive
from schemas.topics import MANUAL
from touchline.cli.bus_client import bus_client
from touchline.cli.option_groups import with_option_groups
from touchline.cli.terminal import KeyReader, terminal
from touchline.drive.keys import KEYS, KeyState, Speeds, manual_drive, press_keys, status

if TYPE_CHECKING:
    from schemas.bus.contract import Bus

_PERIOD = 0.05
"""Wall time between two drive requests to the host, s."""

_USUAL = Speeds()


@with_option_groups
def drive(
    robot: Annotated[str, typer.Argument(metavar="ROBOT", help="cyan1, magenta3, …")],
    speed: Annotated[float, typer.Option(min=0.0, max=20.0, help="m/s along each axis.")] = _USUAL.drive,
    turn: Annotated[float, typer.Option(min=0.0, max=50.0, help="rad/s.")] = _USUAL.turn,
    kick: Annotated[float, typer.Option(min=0.1, max=40.0, help="m/s.")] = _USUAL.kick,
    *,
    connection: ClientSettings,
) -> None:
    """Drive one robot of a running match by keys; Ctrl-C returns it to its brain.

    Arrows move, comma and period turn, z switches the dribbler, x the kind of kick, and space kicks.

    Example: touchline drive cyan2 --speed 2
    """
    with terminal("drive") as keys, bus_client(connection, Account.OPERATOR) as bus:
        typer.echo(", ".join(f"{'space' if key == ' ' else key}: {words}" for key, (words, _) in KEYS.items()))
        drive_by_keys(bus, robot, keys, Speeds(speed, turn, kick), lambda line: typer.echo(line))


def drive_by_keys(bus: "Bus", robot: str, keys: KeyReader, speeds: Speeds, log: Callable[[str], None]) -> None:
    """Drive until the keys are interrupted; the robot is always returned to its brain.

    Raises:
        TouchlineError: no robot of the match has that name.
        MatchFailedError: the host went away.
    """
    from coach_gateway.match.host_client import HostClient

    names = [name for team in HostClient(bus).setup().teams.values() for name in team.robots]
    if robot not in names:
        raise TouchlineError(f'robot is "{robot}", which does not play; {did_you_mean(robot, names)}')
    publisher, state, clock = bus.publisher(MANUAL, robot=robot), KeyState(), bus.clock
    log(status(state))
    try:
        while bus.connected():
            before, state = state, press_keys(state, keys(_PERIOD), clock.now())
            publisher.put(manual_drive(state, speeds, clock.now()))
            state = replace(state, kicks=False)
            if status(state) != status(before):
                log(status(state))
    except KeyboardInterrupt:
        log(f"{robot} is returned to its brain")
        return
    finally:
        publisher.put(ManualDrive(release=True))
    raise MatchFailedError("the host is gone")
