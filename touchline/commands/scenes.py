"""`touchline scene list`: lists the built-in scenes, or shows one."""

from typing import Annotated

import typer

from schemas.config.scene import load_scene, shipped_scenes
from touchline.commands.cli import options
from touchline.launch.terminal.aligned import aligned
from touchline.launch.terminal.json_text import json_text


def scenes(
    name: Annotated[
        str | None, typer.Argument(metavar="[NAME]", help="A built-in scene, or the path of a file.")
    ] = None,
    json: options.Json = False,
) -> None:
    """List the scenes that a match can start in, or show one.

    Example: touchline scene list penalty
    """
    if name is None:
        found = {shipped: load_scene(shipped).description for shipped in shipped_scenes()}
        if json:
            typer.echo(json_text(found, indent=2))
            return
        for line in aligned(list(found.items())):
            typer.echo(line)
        return
    scene = load_scene(name)
    if json:
        typer.echo(scene.model_dump_json(indent=2))
        return
    typer.echo(f"{scene.name}: {scene.description}")
    game, ball = scene.game, scene.ball
    taker = f" for {game.side}" if game.side is not None else ""
    typer.echo(f"game      {game.phase.replace('_', ' ')}{taker}, {game.score.cyan} : {game.score.magenta}")
    typer.echo(f"ball      {_place(ball.x, ball.y)}{_moving(ball.vx, ball.vy)}")
    for robot in scene.robots:
        words = [robot.type if robot.type != "standard" else "", "goalkeeper" if robot.keeper else ""]
        words.append("" if robot.agent else "stands still")
        about = ", ".join(filter(None, words))
        typer.echo(f"{robot.name:<9} {_place(robot.x, robot.y)}{_moving(robot.vx, robot.vy)}  {about}".rstrip())
    for one in scene.obstacles:
        typer.echo(f"{one.name:<9} {_place(one.place[0], one.place[1])}  {one.shape}")


def _place(x: float, y: float) -> str:
    return f"({x:6.2f}, {y:6.2f})"


def _moving(vx: float, vy: float) -> str:
    return f"  moving ({vx:g}, {vy:g}) m/s" if vx or vy else ""
