"""`touchline referee`: the referee box of a running match."""

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Annotated, ClassVar, NamedTuple

import typer

from coach_gateway.access.referee_name import terminal_name
from runtime.access.accounts import Account
from runtime.bus.settings import ClientSettings
from schemas.messages.soccer.game import RefereeAction
from schemas.messages.soccer.referee_seat import SeatOperation, SeatReply, SeatRequest
from schemas.soccer.game import ActionName
from schemas.topics import ACTION, REFEREE_SEAT
from touchline.commands import admit
from touchline.commands.cli import options
from touchline.commands.cli.bus_client import ask_host
from touchline.commands.cli.option_groups import from_options, with_option_groups

app = typer.Typer(
    no_args_is_help=True,
    help="Send requests to the referee of a running match, or officiate.\n\nExample: touchline referee kickoff magenta",
)


@dataclass(frozen=True)
class NoTarget:
    """An action on the game as a whole; `example` is that of a target in the help."""

    example: ClassVar[str] = ""


@dataclass(frozen=True)
class SideTarget:
    """An action on a side."""

    example: ClassVar[str] = "cyan"
    side: options.ForSide


@dataclass(frozen=True)
class RobotTarget:
    """An action on a robot."""

    example: ClassVar[str] = "cyan3"
    robot: Annotated[str, typer.Argument(metavar="ROBOT", help="The robot's name.")]


@dataclass(frozen=True)
class PlaceTarget:
    """An action on a point of the field."""

    example: ClassVar[str] = "-3.5 2"
    x: Annotated[float, typer.Argument(help="m, field frame")]
    y: Annotated[float, typer.Argument(help="m, field frame")]


Target = NoTarget | SideTarget | RobotTarget | PlaceTarget


class RefereeCommand(NamedTuple):
    """One command of the referee box."""

    action: ActionName
    target: type[Target]
    help: str


REFEREE_COMMANDS: dict[str, RefereeCommand] = {
    "start": RefereeCommand(ActionName.START, NoTarget, "Give START: begin the match, or allow a restart."),
    "stop": RefereeCommand(ActionName.STOP, NoTarget, "Stop play."),
    "kickoff": RefereeCommand(ActionName.KICK_OFF, SideTarget, "Stop play and give a side the kick-off."),
    "freekick": RefereeCommand(ActionName.FREE_KICK, SideTarget, "Stop play and give a side a free kick."),
    "goalkick": RefereeCommand(ActionName.GOAL_KICK, SideTarget, "Stop play and give a side a goal kick."),
    "throwin": RefereeCommand(ActionName.THROW_IN, SideTarget, "Stop play and give a side a throw-in."),
    "corner": RefereeCommand(ActionName.CORNER, SideTarget, "Stop play and give a side a corner."),
    "penalty": RefereeCommand(ActionName.PENALTY, SideTarget, "Stop play and give a side a penalty."),
    "drop-ball": RefereeCommand(ActionName.DROP_BALL, NoTarget, "Stop play and drop the ball."),
    "place-ball": RefereeCommand(
        ActionName.PLACE_BALL, PlaceTarget, "Set the ball down on a point of the field, at rest."
    ),
    "goal": RefereeCommand(ActionName.GOAL, SideTarget, "Count a goal for a side."),
    "cancel-goal": RefereeCommand(
        ActionName.CANCEL_GOAL, SideTarget, "Subtract a goal from a side's score; the game continues."
    ),
    "yellow-card": RefereeCommand(ActionName.YELLOW_CARD, RobotTarget, "Show a robot the yellow card."),
    "double-yellow": RefereeCommand(
        ActionName.DOUBLE_YELLOW, RobotTarget, "Show a robot its second yellow card: it is suspended."
    ),
    "red-card": RefereeCommand(ActionName.RED_CARD, RobotTarget, "Show a robot the red card: it leaves the field."),
    "repair": RefereeCommand(ActionName.REPAIR, RobotTarget, "Take a robot off for repair; it returns at a stoppage."),
    "substitute": RefereeCommand(ActionName.SUBSTITUTE, RobotTarget, "Replace a robot during a stoppage."),
    "park": RefereeCommand(ActionName.PARK, RobotTarget, "Take a robot off the field until `enter` brings it back."),
    "enter": RefereeCommand(ActionName.ENTER, RobotTarget, "Bring a robot back that is off the field."),
    "name-robot": RefereeCommand(
        ActionName.NAME_ROBOT, RobotTarget, "Name the robot that a card or a repair without a robot concerns."
    ),
    "confirm": RefereeCommand(ActionName.CONFIRM, NoTarget, "Confirm the referee's proposal at once."),
    "overrule": RefereeCommand(ActionName.OVERRULE, NoTarget, "Reject the referee's proposal."),
    "undo": RefereeCommand(
        ActionName.UNDO, NoTarget, "Undo the last decision: restore score and cards; the clock keeps running."
    ),
    "end-half": RefereeCommand(ActionName.END_HALF, NoTarget, "End this half."),
    "end-game": RefereeCommand(ActionName.END_GAME, NoTarget, "End the match."),
}
"""Command → the action requested from the referee."""


def _command(row: RefereeCommand) -> Callable[..., None]:
    def command(target: Target, connection: ClientSettings) -> None:
        content = asdict(target)
        if isinstance(target, PlaceTarget):
            content = {"place": content}
        action = from_options(RefereeAction, action=row.action, **content)
        ask_host(connection, ACTION, action.replace(referee=terminal_name()), Account.REFEREE)
        typer.echo(f"{row.action.value} accepted")

    command.__annotations__["target"] = row.target
    return with_option_groups(command)


for _word, _row in REFEREE_COMMANDS.items():
    app.command(
        _word,
        help=f"{_row.help}\n\nExample: touchline referee {_word} {_row.target.example}".rstrip(),
        context_settings={"ignore_unknown_options": _row.target is PlaceTarget},  # a negative number is no option
    )(_command(_row))


class SeatCommand(NamedTuple):
    """One command on the seat of the referee."""

    operation: SeatOperation
    help: str


SEAT_COMMANDS: dict[str, SeatCommand] = {
    "seat": SeatCommand(SeatOperation.SHOW, "Print who officiates: one referee at a time."),
    "take-over": SeatCommand(
        SeatOperation.TAKE, "Officiate in place of the referee that does, or before anybody does."
    ),
    "leave": SeatCommand(SeatOperation.LEAVE, "Stop officiating: the next one that decides is the referee."),
}
"""Command → what it does with the seat."""


def _seat_command(row: SeatCommand) -> Callable[..., None]:
    def command(connection: ClientSettings) -> None:
        request = SeatRequest(operation=row.operation, referee=terminal_name())
        reply: SeatReply = ask_host(connection, REFEREE_SEAT, request, Account.REFEREE)
        typer.echo(f"{reply.holder} officiates" if reply.holder is not None else "the referee's seat is free")

    return with_option_groups(command)


for _word, _seat in SEAT_COMMANDS.items():
    app.command(_word, help=f"{_seat.help}\n\nExample: touchline referee {_word}")(_seat_command(_seat))

app.command("admit-recorder")(admit.recorder)
