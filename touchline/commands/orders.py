"""`touchline coach order` and `touchline coach test`: send orders to a side and report the acknowledgements."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

import typer

from coach_gateway.match.host_client import HostClient
from runtime.access.accounts import Account
from runtime.bus.settings import ClientSettings
from runtime.process.timing import REQUEST_S
from schemas.messages.coach import CoachMode, CoachOrder, CoachTest
from schemas.messages.command import KickMode
from schemas.side import Side
from schemas.soccer.game import Point
from schemas.wire.part_faults import validated
from touchline.commands.cli import options
from touchline.commands.cli.bus_client import bus_client
from touchline.commands.cli.option_groups import from_options, with_option_groups
from touchline.launch.terminal.json_text import json_text

if TYPE_CHECKING:
    from coach_gateway.match.orders import Receipt


def _point(text: str) -> Point:
    """`2,-1.5` as a point."""
    try:
        x, y = (float(part) for part in text.split(","))
        return validated(Point, {"x": x, "y": y})
    except ValueError:
        raise typer.BadParameter(f"{text} is no point; write x and y in m, like 2,-1.5") from None


PointOption = Annotated[Point | None, typer.Option(metavar="X,Y", parser=_point, help="m, team frame.")]
AngleOption = Annotated[float | None, typer.Option(help="rad, team frame.")]


@dataclass(frozen=True)
class OrderOptions:
    """Points, robots, kicks and limits of an order; every test reads its arguments from here."""

    robot_a: Annotated[
        str | None, typer.Option("--robot-a", "--robot", metavar="ROBOT", help="The acting robot, of that side.")
    ] = None
    robot_b: Annotated[
        str | None, typer.Option("--robot-b", "--receiver", metavar="ROBOT", help="The receiving robot, of that side.")
    ] = None
    point_a: PointOption = None
    point_b: PointOption = None
    angle_a: AngleOption = None
    angle_b: AngleOption = None
    radius: Annotated[float | None, typer.Option(help="Radius of a circle, m; above 0, at most 20.")] = None
    with_ball: Annotated[bool, typer.Option("--with-ball", help="Get the ball first and carry it along.")] = False
    avoid: Annotated[bool, typer.Option("--avoid", help="Drive around obstacles.")] = False
    kick_speed: Annotated[float | None, typer.Option(help="m/s; above 0, at most 40.")] = None
    kick_mode: Annotated[KickMode, typer.Option(help="Kick mode of a test.")] = KickMode.GROUND
    max_speed: Annotated[float | None, typer.Option(help="m/s; above 0, at most 20.")] = None
    max_turn_rate: Annotated[float | None, typer.Option(help="rad/s; above 0, at most 50.")] = None


@dataclass(frozen=True)
class AcknowledgementOptions:
    """How long to wait for acknowledgements, and how to print them."""

    wait: Annotated[float, typer.Option(min=0.0, help="Time to wait for acknowledgements, s.")] = REQUEST_S
    json: options.Json = False


@with_option_groups
def order(
    side: options.ForSide,
    mode: Annotated[
        CoachMode | None, typer.Option(help="The team's mode while play allows it; by default play.")
    ] = None,
    test: Annotated[CoachTest | None, typer.Option(help="The test to run; implies the mode test.")] = None,
    tactic: Annotated[str, typer.Option(help="A tactic that the team's own code defines.")] = "",
    *,
    order_options: OrderOptions,
    acknowledgement: AcknowledgementOptions,
    connection: ClientSettings,
) -> None:
    """Send a new standing order to a side and report which robots acknowledged it.

    Example: touchline coach order cyan --mode hold --max-speed 1.5
    """
    mode = mode or (CoachMode.TEST if test is not None else CoachMode.PLAY)
    _order(side, order_options, acknowledgement, connection, mode=mode, test=test, tactic=tactic)


@with_option_groups
def test(
    side: options.ForSide,
    test: Annotated[CoachTest, typer.Argument(help="The test for the named robot; the other robots stand still.")],
    order_options: OrderOptions,
    acknowledgement: AcknowledgementOptions,
    connection: ClientSettings,
) -> None:
    """Run one test with robots of a side: drive to a point, circle, pass, catch, shoot.

    `touchline coach order SIDE` ends the test; the robots play again.

    Example: touchline coach test cyan move --robot cyan2 --point-a 2,1 --avoid
    """
    _order(side, order_options, acknowledgement, connection, mode=CoachMode.TEST, test=test)


def _order(
    side: Side,
    order_options: OrderOptions,
    acknowledgement: AcknowledgementOptions,
    connection: ClientSettings,
    **more: Any,
) -> None:
    content = vars(order_options) | more
    from_options(CoachOrder, sequence=1, **content)
    with bus_client(connection, Account.of_coach(side)) as bus:
        client = HostClient(bus)
        client.orders.update()  # subscribe first, so that no status of the order is missed
        given = client.order(side, **content)
        receipt = client.wait_for_robots(side, given, acknowledgement.wait)
    typer.echo(_as_json(side, given, receipt) if acknowledgement.json else _in_words(side, given, receipt))
    if receipt.refused:
        raise typer.Exit(1)


def _in_words(side: Side, order: CoachOrder, receipt: "Receipt") -> str:
    what = order.mode.value if order.test is None else f"{order.mode.value} {order.test.value}"
    return f"order {order.sequence} to {side.value}: {what}; {receipt}"


def _as_json(side: Side, order: CoachOrder, receipt: "Receipt") -> str:
    fields = {"side": side, "sequence": order.sequence, "status": receipt.status}
    robots = {"acknowledged": receipt.acknowledged, "missing": receipt.missing, "refused": receipt.refused}
    return json_text(fields | robots)
