"""`touchline identify`: the numbers of a robot, from a recording of its commands and poses."""

from pathlib import Path
from typing import Annotated

import typer

from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.errors import os_errors
from touchline.commands.cli import options
from touchline.launch.terminal.json_text import json_text


def identify(
    recording: Annotated[Path, typer.Argument(metavar="RECORDING", help="A recording with sights and commands.")],
    robot: Annotated[str, typer.Option(help="Name of the robot in it.")] = "cyan1",
    profile: Annotated[
        str, typer.Option(help="The profile within whose limits its demands were kept; the new one extends it.")
    ] = "msl",
    out: Annotated[Path | None, typer.Option(help="File of the new profile; by default it is printed.")] = None,
    json: options.Json = False,
) -> None:
    """Find top speeds, accelerations, latency, noise and delay of the camera of a robot, and write a profile.

    The robot should start, stop and turn often, beyond its limits, for a minute: docs/real_robots.md has a brain for
    that.

    Example: touchline identify run.mcap --robot cyan2 --out my_robot.toml
    """
    from touchline.hardware import identify as identification
    from touchline.hardware.robot_track import read_track

    model = RobotModel.standard(load_profile(profile))
    numbers = identification.identify(read_track(recording, robot), model)
    if json:
        typer.echo(json_text(numbers._asdict()))
        return
    text = identification.profile_text(numbers, profile, f"identified in {recording.name}")
    if out is None:
        typer.echo(text, nl=False)
        return
    with os_errors(f"--out {out}", "give a path that can be written"):
        out.write_text(text, "utf-8")
    typer.echo(f'{out}: latency of commands {1e3 * numbers.latency:.0f} ms; play with it by `profile = "{out}"`')
