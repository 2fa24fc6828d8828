"""`touchline scene`: sets up the pitch of a running match."""

from pathlib import Path
from typing import Annotated, Any

import typer

from runtime.bus.settings import ClientSettings
from schemas.config.scene import REMEDIES, load_scene
from schemas.config.toml_file import table_error
from schemas.errors import TouchlineError
from schemas.messages.scene import SceneReply, SceneRequest
from schemas.side import Side
from schemas.topics import SCENE
from schemas.wire.faults import FaultError
from schemas.wire.part_faults import validated
from touchline.commands.cli.bus_client import ask_host
from touchline.commands.cli.option_groups import with_option_groups
from touchline.commands.scenes import scenes

app = typer.Typer(
    no_args_is_help=True,
    help="Set up the pitch of a running match: load a scene, place, add or remove bodies, reset; list scenes.\n\n"
    "Example: touchline scene load penalty",
)
app.command("list")(scenes)

_NUMBERS: Any = {"ignore_unknown_options": True}
"""A negative number is an argument, not an option."""

X = Annotated[float, typer.Argument(help="m, field frame")]
Y = Annotated[float, typer.Argument(help="m, field frame")]
Heading = Annotated[float, typer.Option(help="rad, field frame.")]
Vx = Annotated[float, typer.Option(help="m/s, field frame.")]
Vy = Annotated[float, typer.Option(help="m/s, field frame.")]
Omega = Annotated[float, typer.Option(help="rad/s; of a robot.")]


@app.command("load")
@with_option_groups
def load(
    name: Annotated[str, typer.Argument(help="A built-in scene, or the path of a .toml file.")],
    connection: ClientSettings,
) -> None:
    """Start a new episode from a scene: its robots, ball and game state.

    Example: touchline scene load two_on_one
    """
    content = {"scene": load_scene(name).model_dump(mode="json")} if Path(name).suffix == ".toml" else {"load": name}
    _send(connection, operation="load", **content)


@app.command("place", context_settings=_NUMBERS)
@with_option_groups
def place(
    body: Annotated[str, typer.Argument(help="A robot's name, or ball.")],
    x: X,
    y: Y,
    heading: Heading = 0.0,
    vx: Vx = 0.0,
    vy: Vy = 0.0,
    omega: Omega = 0.0,
    z: Annotated[float | None, typer.Option(help="m, height of the ball's centre.")] = None,
    vz: Annotated[float, typer.Option(help="m/s; of the ball.")] = 0.0,
    *,
    connection: ClientSettings,
) -> None:
    """Place a robot or the ball, at rest or moving.

    Example: touchline scene place ball -3.5 2 --vx 4
    """
    at = {"body": body, "x": x, "y": y, "heading": heading, "z": z, "vx": vx, "vy": vy, "vz": vz, "omega": omega}
    _send(connection, operation="place", place=[at])


@app.command("add", context_settings=_NUMBERS)
@with_option_groups
def add(
    name: Annotated[str, typer.Argument(help="Name of the new robot.")],
    side: Annotated[Side, typer.Argument(help="cyan or magenta")],
    x: X,
    y: Y,
    heading: Heading = 0.0,
    type_: Annotated[str, typer.Option("--type", help="Type of robot, as the profile names it.")] = "standard",
    still: Annotated[bool, typer.Option("--still", help="The robot stands still and needs no agent.")] = False,
    *,
    connection: ClientSettings,
) -> None:
    """Add a robot; it rests until its agent connects.

    Agents join as robots of the match file, and as cyan1 to cyan11 and magenta1 to magenta11. A robot that is added
    with another name has no agent: the page drives it, or it rests.

    Example: touchline scene add magenta6 magenta 5 -2 --type slow
    """
    robot = {"name": name, "side": side, "x": x, "y": y, "heading": heading, "type": type_, "agent": not still}
    _send(connection, operation="add", robots=[robot])


@app.command("add-obstacle", context_settings=_NUMBERS)
@with_option_groups
def add_obstacle(
    name: Annotated[str, typer.Argument(help="Name of the new obstacle.")],
    x: X,
    y: Y,
    radius: Annotated[float | None, typer.Option(help="m; of a cylinder.")] = None,
    height: Annotated[float | None, typer.Option(help="m; of a cylinder.")] = None,
    size: Annotated[tuple[float, float, float] | None, typer.Option(metavar="X Y Z", help="m; of a box.")] = None,
    heading: Heading = 0.0,
    *,
    connection: ClientSettings,
) -> None:
    """Add an immovable cylinder or box.

    Example: touchline scene add-obstacle wall 3 -2 --size 0.2 2 0.5
    """
    if (size is None) == (radius is None or height is None):
        raise TouchlineError(f"{name} has no shape; give --radius and --height of a cylinder, or --size of a box")
    shape, box = ("cylinder", None) if size is None else ("box", list(size))
    body = {"name": name, "shape": shape, "place": [x, y], "heading": heading, "radius": radius, "height": height}
    _send(connection, operation="add", obstacles=[body | {"size": box}])


@app.command("remove")
@with_option_groups
def remove(
    names: Annotated[list[str], typer.Argument(metavar="NAME...", help="Robots and obstacles.")],
    connection: ClientSettings,
) -> None:
    """Take robots or obstacles off the pitch; a removed robot's agent receives no sights until it is back.

    Example: touchline scene remove cyan4 magenta4
    """
    _send(connection, operation="remove", remove=names)


@app.command("reset")
@with_option_groups
def reset(
    to_start: Annotated[
        bool, typer.Option("--to-start", help="Go to the start of the match, not of the scene.")
    ] = False,
    *,
    connection: ClientSettings,
) -> None:
    """Start a new episode: the last loaded scene, or the match, from its start.

    Example: touchline scene reset
    """
    _send(connection, operation="reset", to_match=to_start)


def _send(connection: ClientSettings, **content: Any) -> None:
    try:
        request = validated(SceneRequest, content)
    except FaultError as error:
        raise table_error(error.fault, f"scene {content['operation']}", REMEDIES) from None
    reply: SceneReply = ask_host(connection, SCENE, request)
    typer.echo(f"{request.operation.value} accepted, episode {reply.episode}")
