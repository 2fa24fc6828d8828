"""`touchline coach order` and `touchline coach test`: what a side shall do, and which of its robots have heard."""

import json as json_text
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Annotated, Any

import typer

from schemas.bus.settings import ClientSettings
from schemas.game import Point
from schemas.messages.coach import CoachMode, CoachOrder, CoachTest
from schemas.messages.command import KickMode
from schemas.side import Side
from schemas.wire.struct import check
from touchline.cli import options
from touchline.cli.bus_client import bus_client
from touchline.cli.option_groups import from_options, with_option_groups

if TYPE_CHECKING:
    from coach_gateway.match.orders import Receipt

ORDER_WAIT = 2.0
"""s of wall time; how long a coach who is asked for nothing else waits for the robots."""


def _point(words: str) -> Point:
    """`2,-1.5` as a point."""
    try:
        x, y = (float(word) for word in words.split(","))
        point = Point(x=x, y=y)
        check(point)
    except ValueError:
        raise typer.BadParameter(f"{words} is no point; write x and y in m, like 2,-1.5") from None
    return point


PointOption = Annotated[Point | None, typer.Option(metavar="X,Y", parser=_point, help="m, team frame.")]
AngleOption = Annotated[float | None, typer.Option(help="rad, team frame.")]


@dataclass(frozen=True)
class OrderOptions:
    """What an order says of points, robots, kicks and limits; whatever the test is, it reads them from here."""

    robot_a: Annotated[
        str | None, typer.Option("--robot-a", "--robot", metavar="ROBOT", help="Who acts: a robot of that side.")
    ] = None
    robot_b: Annotated[
        str | None, typer.Option("--robot-b", "--to", metavar="ROBOT", help="Who receives: a robot of that side.")
    ] = None
    point_a: PointOption = None
    point_b: PointOption = None
    angle_a: AngleOption = None
    angle_b: AngleOption = None
    radius: Annotated[float | None, typer.Option(help="m, of a circle; above 0 to 20.")] = None
    with_ball: Annotated[bool, typer.Option("--with-ball", help="Get the ball first, and bring it along.")] = False
    avoid: Annotated[bool, typer.Option("--avoid", help="Go around whatever is in the way.")] = False
    kick_speed: Annotated[float | None, typer.Option(help="m/s, above 0 to 40.")] = None
    kick_mode: Annotated[KickMode, typer.Option(help="How a test shoots.")] = KickMode.GROUND
    max_speed: Annotated[float | None, typer.Option(help="m/s, above 0 to 20.")] = None
    max_turn_rate: Annotated[float | None, typer.Option(help="rad/s, above 0 to 50.")] = None


@dataclass(frozen=True)
class AcknowledgementOptions:
    """How long the robots are given to acknowledge, and how that is shown."""

    wait: Annotated[float, typer.Option(min=0.0, help="s to wait for the robots to acknowledge it.")] = ORDER_WAIT
    json: options.Json = False


@with_option_groups
def order(
    side: options.ForSide,
    mode: Annotated[
        CoachMode | None, typer.Option(help="What the team shall do while the game allows it; otherwise play.")
    ] = None,
    test: Annotated[CoachTest | None, typer.Option(help="What a test shows; the mode is test.")] = None,
    tactic: Annotated[str, typer.Option(help="A word that the team's own code understands.")] = "",
    *,
    order_options: OrderOptions,
    acknowledgement: AcknowledgementOptions,
    connection: ClientSettings,
) -> None:
    """Give a side its new standing order, and say which robots have acknowledged it.

    Example: touchline coach order cyan --mode hold --max-speed 1.5
    """
    mode = mode or (CoachMode.TEST if test is not None else CoachMode.PLAY)
    _order(side, order_options, acknowledgement, connection, mode=mode, test=test, tactic=tactic)


@with_option_groups
def test(
    side: options.ForSide,
    test: Annotated[CoachTest, typer.Argument(help="What the named robot shows; the others stand still.")],
    order_options: OrderOptions,
    acknowledgement: AcknowledgementOptions,
    connection: ClientSettings,
) -> None:
    """Have robots of a side show one thing: drive to a point, circle, pass, catch, shoot.

    `touchline coach order SIDE` lets them play again.

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
    from coach_gateway.match.host_client import HostClient

    content = {**{key: getattr(order_options, key) for key in (field.name for field in fields(order_options))}, **more}
    from_options(CoachOrder, sequence=1, **content)
    with bus_client(connection.connect, connection.match) as bus:
        client = HostClient(bus)
        client.orders.update()  # so that what the host says of the order is heard from the first word
        given = client.order(side, **content)
        receipt = client.wait_for_robots(side, given, acknowledgement.wait)
    typer.echo(_as_json(side, given, receipt) if acknowledgement.json else _in_words(side, given, receipt))


def _in_words(side: Side, order: CoachOrder, receipt: "Receipt") -> str:
    what = order.mode.value if order.test is None else f"{order.mode.value} {order.test.value}"
    return f"order {order.sequence} to {side.value}: {what}; {receipt}"


def _as_json(side: Side, order: CoachOrder, receipt: "Receipt") -> str:
    fields = {"side": side, "sequence": order.sequence, "status": receipt.status}
    return json_text.dumps({**fields, "acknowledged": receipt.acknowledged, "missing": receipt.missing})
