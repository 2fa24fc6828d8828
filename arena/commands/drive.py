"""`touchline drive`: one robot driven by keys, in place of its brain."""

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

import typer

from arena import options
from arena.bundle import unbundled
from arena.keyboard import KEYS, Hand, Speeds, pressed, said, status
from arena.seat import seat as _seat
from arena.terminal import Keys, terminal
from schemas.errors import MatchFailedError, TouchlineError, did_you_mean
from schemas.hand import HandDrive
from schemas.topics import HAND

if TYPE_CHECKING:
    from schemas.bus.contract import Bus

_PERIOD = 0.05
"""s of wall time between two words to the host."""

_USUAL = Speeds()


@unbundled
def drive(
    robot: Annotated[str, typer.Argument(metavar="ROBOT", help="cyan1, magenta3, …")],
    speed: Annotated[float, typer.Option(min=0.0, max=20.0, help="m/s along each axis.")] = _USUAL.drive,
    turn: Annotated[float, typer.Option(min=0.0, max=50.0, help="rad/s.")] = _USUAL.turn,
    kick: Annotated[float, typer.Option(min=0.1, max=40.0, help="m/s.")] = _USUAL.kick,
    *,
    seat: options.Seat,
) -> None:
    """Drive one robot of a running match by keys; Ctrl-C gives it back to its brain.

    Arrows move, comma and period turn, z switches the dribbler, x the kind of kick, and space kicks.

    Example: touchline drive cyan2 --speed 2
    """
    with terminal("drive") as keys, _seat(seat.connect, seat.match) as bus:
        typer.echo(", ".join(f"{'space' if key == ' ' else key}: {words}" for key, (words, _) in KEYS.items()))
        drive_by_keys(bus, robot, keys, Speeds(speed, turn, kick), lambda line: typer.echo(line))


def drive_by_keys(bus: "Bus", robot: str, keys: Keys, speeds: Speeds, say: Callable[[str], None]) -> None:
    """Drive until the keys are interrupted; the robot is given back in any case.

    Raises:
        TouchlineError: no robot of the match has that name.
        MatchFailedError: the host went away.
    """
    from coach_gateway.gateway import Gateway

    names = [name for team in Gateway(bus).setup().teams.values() for name in team.robots]
    if robot not in names:
        raise TouchlineError(f'robot is "{robot}", who does not play; {did_you_mean(robot, names)}')
    words, hand, clock = bus.publisher(HAND, robot=robot), Hand(), bus.clock
    say(status(hand))
    try:
        while bus.connected():
            before, hand = hand, pressed(hand, keys(_PERIOD), clock.now())
            words.put(said(hand, speeds, clock.now()))
            hand = replace(hand, kicks=False)
            if status(hand) != status(before):
                say(status(hand))
    except KeyboardInterrupt:
        say(f"{robot} is given back")
        return
    finally:
        words.put(HandDrive(release=True))
    raise MatchFailedError("the host is gone")
