"""`touchline coach`: the referee box and the coach's bench of a running match."""

from collections.abc import Callable
from typing import Annotated, Any

import typer

from arena import options
from arena.commands.serve import serve
from arena.seat import PATIENCE
from arena.seat import seat as _seat
from schemas.coach import CoachMode, CoachOrder
from schemas.errors import MatchFailedError, TouchlineError
from schemas.game import ActionName, Point, RefereeAction
from schemas.message import reason_of
from schemas.side import Side

app = typer.Typer(
    no_args_is_help=True,
    help="Ask the referee of a running match, order a side, or watch.\n\nExample: touchline coach kickoff magenta",
)

UNSIDED: dict[str, tuple[ActionName, str]] = {
    "start": (ActionName.START, "Give START: begin the match, or let a restart be taken."),
    "stop": (ActionName.STOP, "Stop play."),
    "drop-ball": (ActionName.DROP_BALL, "Stop play and drop the ball."),
    "confirm": (ActionName.CONFIRM, "Decide at once what the referee proposes."),
    "overrule": (ActionName.OVERRULE, "Let what the referee proposes not be decided."),
    "undo": (ActionName.UNDO, "Take the last decision back; score and cards are as before, the clock goes on."),
    "end-half": (ActionName.END_HALF, "End this half."),
    "end-game": (ActionName.END_GAME, "End the match."),
}
"""Command → what it asks the referee for, and its help."""

SIDED: dict[str, tuple[ActionName, str]] = {
    "kickoff": (ActionName.KICK_OFF, "Stop play and give a side the kick-off."),
    "freekick": (ActionName.FREE_KICK, "Stop play and give a side a free kick."),
    "goalkick": (ActionName.GOAL_KICK, "Stop play and give a side a goal kick."),
    "throwin": (ActionName.THROW_IN, "Stop play and give a side a throw-in."),
    "corner": (ActionName.CORNER, "Stop play and give a side a corner."),
    "penalty": (ActionName.PENALTY, "Stop play and give a side a penalty."),
    "goal": (ActionName.GOAL, "Count a goal for a side."),
    "cancel-goal": (ActionName.CANCEL_GOAL, "Take a goal from a side's score; the game goes on as it does."),
}
"""Command that names a side → the same."""

FOR_ROBOT: dict[str, tuple[ActionName, str]] = {
    "yellow-card": (ActionName.YELLOW_CARD, "Show a robot the yellow card."),
    "red-card": (ActionName.RED_CARD, "Show a robot the red card: it leaves the field."),
    "repair": (ActionName.REPAIR, "Take a robot out for repair; it comes back at a stoppage."),
    "substitute": (ActionName.SUBSTITUTE, "Replace a robot, in a stoppage."),
    "park": (ActionName.PARK, "Take a robot off the field until it is told to enter."),
    "enter": (ActionName.ENTER, "Have a robot come back that is off the field."),
}
"""Command that names a robot → the same."""

ForRobot = Annotated[str, typer.Argument(metavar="ROBOT", help="The robot's name.")]
ForSide = Annotated[Side, typer.Argument(help="cyan or magenta")]
PointOption = Annotated[tuple[float, float] | None, typer.Option(metavar="X Y", help="m, team frame.")]
RobotOption = Annotated[str | None, typer.Option(metavar="ROBOT", help="A robot of that side.")]
AngleOption = Annotated[float | None, typer.Option(help="rad, team frame.")]


def _unsided(action: ActionName) -> Callable[..., None]:
    def command(
        connect: options.Connect = options.DEFAULT_ENDPOINT, match: options.Match = options.DEFAULT_MATCH
    ) -> None:
        _act(connect, match, RefereeAction(action=action))

    return command


def _sided(action: ActionName) -> Callable[..., None]:
    def command(
        side: ForSide, connect: options.Connect = options.DEFAULT_ENDPOINT, match: options.Match = options.DEFAULT_MATCH
    ) -> None:
        _act(connect, match, RefereeAction(action=action, side=side))

    return command


def _for_robot(action: ActionName) -> Callable[..., None]:
    def command(
        robot: ForRobot,
        connect: options.Connect = options.DEFAULT_ENDPOINT,
        match: options.Match = options.DEFAULT_MATCH,
    ) -> None:
        _act(connect, match, _checked(RefereeAction, action=action, robot=robot))

    return command


for _name, (_action, _help) in UNSIDED.items():
    app.command(_name, help=f"{_help}\n\nExample: touchline coach {_name}")(_unsided(_action))
for _name, (_action, _help) in SIDED.items():
    app.command(_name, help=f"{_help}\n\nExample: touchline coach {_name} cyan")(_sided(_action))

for _name, (_action, _help) in FOR_ROBOT.items():
    app.command(_name, help=f"{_help}\n\nExample: touchline coach {_name} cyan3")(_for_robot(_action))


@app.command("place-ball", context_settings={"ignore_unknown_options": True})
def place_ball(
    x: Annotated[float, typer.Argument(help="m, field frame")],
    y: Annotated[float, typer.Argument(help="m, field frame")],
    connect: options.Connect = options.DEFAULT_ENDPOINT,
    match: options.Match = options.DEFAULT_MATCH,
) -> None:
    """Set the ball down on a point of the field, at rest.

    Example: touchline coach place-ball -3.5 2
    """
    _act(connect, match, RefereeAction(action=ActionName.PLACE_BALL, place=_point((x, y))))


@app.command("order")
def order(
    side: ForSide,
    mode: Annotated[CoachMode, typer.Option(help="What the team shall do while the game allows it.")] = CoachMode.PLAY,
    tactic: Annotated[str, typer.Option(help="A word that the team's own code understands.")] = "",
    point_a: PointOption = None,
    point_b: PointOption = None,
    angle_a: AngleOption = None,
    angle_b: AngleOption = None,
    robot_a: RobotOption = None,
    robot_b: RobotOption = None,
    kick_speed: Annotated[float | None, typer.Option(help="m/s, above 0 to 40.")] = None,
    max_speed: Annotated[float | None, typer.Option(help="m/s, above 0 to 20.")] = None,
    max_turn_rate: Annotated[float | None, typer.Option(help="rad/s, above 0 to 50.")] = None,
    connect: options.Connect = options.DEFAULT_ENDPOINT,
    match: options.Match = options.DEFAULT_MATCH,
) -> None:
    """Give a side its new standing order.

    Example: touchline coach order cyan --mode hold --max-speed 1.5
    """
    from coach_gateway.gateway import Gateway

    content = {
        "mode": mode,
        "tactic": tactic,
        "point_a": _point(point_a),
        "point_b": _point(point_b),
        "angle_a": angle_a,
        "angle_b": angle_b,
        "robot_a": robot_a,
        "robot_b": robot_b,
        "kick_speed": kick_speed,
        "max_speed": max_speed,
        "max_turn_rate": max_turn_rate,
    }
    _checked(CoachOrder, sequence=1, **content)
    with _seat(connect, match) as bus:
        given = Gateway(bus).order(side, **content)
    typer.echo(f"order {given.sequence} to {side.value}: {given.mode.value}")


@app.command("state")
def state(
    connect: options.Connect = options.DEFAULT_ENDPOINT,
    match: options.Match = options.DEFAULT_MATCH,
    json: options.Json = False,
) -> None:
    """Show once how the match stands.

    Example: touchline coach state --json | jq .score
    """
    from coach_gateway.lines import state_line
    from coach_gateway.view import MatchView

    with _seat(connect, match) as bus:
        view = MatchView(bus)
        found = view.wait_for_state(PATIENCE)
    if found is None and view.health is not None:
        there = sum(robot.alive for robot in view.health.robots.values())
        raise MatchFailedError(f'match "{match}" has not begun: {there} of {len(view.health.robots)} robots are there')
    if found is None:
        raise TouchlineError(f'match "{match}": the host says nothing of it; name the match it plays with --match')
    typer.echo(found.model_dump_json(exclude={"version"}) if json else state_line(found))


app.command("serve")(serve)


@app.command("watch")
def watch(connect: options.Connect = options.DEFAULT_ENDPOINT, match: options.Match = options.DEFAULT_MATCH) -> None:
    """Show the match as plain lines until its host goes, or until Ctrl-C.

    Example: touchline coach watch --connect tcp/192.168.1.5:7447
    """
    from coach_gateway.__main__ import run

    run(connect, match, PATIENCE)


def _act(connect: str, match: str, action: RefereeAction) -> None:
    from coach_gateway.gateway import Gateway

    with _seat(connect, match) as bus:
        reply = Gateway(bus).act(action)
    if not reply.accepted:
        raise MatchFailedError(f"refused: {reply.reason}")
    typer.echo(f"{action.action.value} accepted")


def _point(place: tuple[float, float] | None) -> Point | None:
    return _checked(Point, x=place[0], y=place[1]) if place is not None else None


def _checked(model: Any, **content: Any) -> Any:
    """The message of what was typed in.

    Raises:
        TouchlineError: a value that it may not have.
    """
    from pydantic import ValidationError

    try:
        return model(**content)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        if not first["loc"]:
            raise TouchlineError(reason_of(error)) from None
        option = "--" + "-".join(str(first["loc"][0]).split("_"))
        raise TouchlineError(f"{option} is {first['input']}: {first['msg'][0].lower()}{first['msg'][1:]}") from None
