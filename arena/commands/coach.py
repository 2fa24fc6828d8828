"""`touchline coach`: the referee box and the coach's bench of a running match."""

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Annotated, NamedTuple

import typer

from arena import options
from arena.bundle import unbundled
from arena.commands import orders
from arena.commands.bridge import bridge
from arena.commands.serve import serve
from arena.seat import PATIENCE
from arena.seat import seat as _seat
from arena.typed_in import checked
from schemas.errors import MatchFailedError, TouchlineError
from schemas.game import ActionName, RefereeAction

app = typer.Typer(
    no_args_is_help=True,
    help="Ask the referee of a running match, order a side, or watch.\n\nExample: touchline coach kickoff magenta",
)


@dataclass(frozen=True)
class Nobody:
    """An action that is about the game."""


@dataclass(frozen=True)
class OneSide:
    """An action that is for a side."""

    side: options.ForSide


@dataclass(frozen=True)
class OneRobot:
    """An action that is about a robot."""

    robot: Annotated[str, typer.Argument(metavar="ROBOT", help="The robot's name.")]


@dataclass(frozen=True)
class OnePlace:
    """An action that is about a point of the field."""

    x: Annotated[float, typer.Argument(help="m, field frame")]
    y: Annotated[float, typer.Argument(help="m, field frame")]


About = Nobody | OneSide | OneRobot | OnePlace


class Deed(NamedTuple):
    """One word of the referee box."""

    action: ActionName
    about: type[About]
    says: str
    example: str = ""
    """What stands behind the word."""


DEEDS: dict[str, Deed] = {
    "start": Deed(ActionName.START, Nobody, "Give START: begin the match, or let a restart be taken."),
    "stop": Deed(ActionName.STOP, Nobody, "Stop play."),
    "kickoff": Deed(ActionName.KICK_OFF, OneSide, "Stop play and give a side the kick-off.", "cyan"),
    "freekick": Deed(ActionName.FREE_KICK, OneSide, "Stop play and give a side a free kick.", "cyan"),
    "goalkick": Deed(ActionName.GOAL_KICK, OneSide, "Stop play and give a side a goal kick.", "cyan"),
    "throwin": Deed(ActionName.THROW_IN, OneSide, "Stop play and give a side a throw-in.", "cyan"),
    "corner": Deed(ActionName.CORNER, OneSide, "Stop play and give a side a corner.", "cyan"),
    "penalty": Deed(ActionName.PENALTY, OneSide, "Stop play and give a side a penalty.", "cyan"),
    "drop-ball": Deed(ActionName.DROP_BALL, Nobody, "Stop play and drop the ball."),
    "place-ball": Deed(
        ActionName.PLACE_BALL, OnePlace, "Set the ball down on a point of the field, at rest.", "-3.5 2"
    ),
    "goal": Deed(ActionName.GOAL, OneSide, "Count a goal for a side.", "cyan"),
    "cancel-goal": Deed(
        ActionName.CANCEL_GOAL, OneSide, "Take a goal from a side's score; the game goes on as it does.", "cyan"
    ),
    "yellow-card": Deed(ActionName.YELLOW_CARD, OneRobot, "Show a robot the yellow card.", "cyan3"),
    "red-card": Deed(ActionName.RED_CARD, OneRobot, "Show a robot the red card: it leaves the field.", "cyan3"),
    "repair": Deed(ActionName.REPAIR, OneRobot, "Take a robot out for repair; it comes back at a stoppage.", "cyan3"),
    "substitute": Deed(ActionName.SUBSTITUTE, OneRobot, "Replace a robot, in a stoppage.", "cyan3"),
    "park": Deed(ActionName.PARK, OneRobot, "Take a robot off the field until it is told to enter.", "cyan3"),
    "enter": Deed(ActionName.ENTER, OneRobot, "Have a robot come back that is off the field.", "cyan3"),
    "confirm": Deed(ActionName.CONFIRM, Nobody, "Decide at once what the referee proposes."),
    "overrule": Deed(ActionName.OVERRULE, Nobody, "Let what the referee proposes not be decided."),
    "undo": Deed(
        ActionName.UNDO, Nobody, "Take the last decision back; score and cards are as before, the clock goes on."
    ),
    "end-half": Deed(ActionName.END_HALF, Nobody, "End this half."),
    "end-game": Deed(ActionName.END_GAME, Nobody, "End the match."),
}
"""Command → what it asks the referee for."""


def _deed(deed: Deed) -> Callable[..., None]:
    def command(about: About, seat: options.Seat) -> None:
        words = asdict(about)
        if isinstance(about, OnePlace):
            words = {"place": words}
        _act(seat, checked(RefereeAction, action=deed.action, **words))

    command.__annotations__["about"] = deed.about
    return unbundled(command)


for _word, _row in DEEDS.items():
    app.command(
        _word,
        help=f"{_row.says}\n\nExample: touchline coach {_word} {_row.example}".rstrip(),
        context_settings={"ignore_unknown_options": _row.about is OnePlace},  # a negative number is none
    )(_deed(_row))


app.command("order")(orders.order)
app.command("test")(orders.test)


@app.command("state")
@unbundled
def state(seat: options.Seat, json: options.Json = False) -> None:
    """Show once how the match stands.

    Example: touchline coach state --json | jq .score
    """
    from coach_gateway.lines import state_line
    from coach_gateway.view import MatchView

    with _seat(seat.connect, seat.match) as bus:
        view = MatchView(bus)
        found = view.wait_for_state(PATIENCE)
    if found is None and view.health is not None:
        there = sum(robot.alive for robot in view.health.robots.values())
        raise MatchFailedError(
            f'match "{seat.match}" has not begun: {there} of {len(view.health.robots)} robots are there'
        )
    if found is None:
        raise TouchlineError(f'match "{seat.match}": the host says nothing of it; name the match it plays with --match')
    typer.echo(found.model_dump_json(exclude={"version"}) if json else state_line(found))


app.command("serve")(serve)
app.command("bridge")(bridge)


@app.command("watch")
@unbundled
def watch(seat: options.Seat) -> None:
    """Show the match as plain lines until its host goes, or until Ctrl-C.

    Example: touchline coach watch --connect tcp/192.168.1.5:7447
    """
    from coach_gateway.__main__ import run

    run(seat.connect, seat.match, PATIENCE)


def _act(seat: options.Seat, action: RefereeAction) -> None:
    from coach_gateway.gateway import Gateway

    with _seat(seat.connect, seat.match) as bus:
        reply = Gateway(bus).act(action)
    if not reply.accepted:
        raise MatchFailedError(f"refused: {reply.reason}")
    typer.echo(f"{action.action.value} accepted")
