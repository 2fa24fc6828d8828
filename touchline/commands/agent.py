"""`touchline agent`: one robot's brain, on this machine or another."""

from typing import Annotated

import typer

from touchline.cli import options
from touchline.cli.option_groups import expand_option_groups


@expand_option_groups
def agent(
    robot: Annotated[str, typer.Option(envvar="TOUCHLINE_ROBOT", help="Name of the robot: cyan1, magenta3, …")],
    brain: Annotated[
        str, typer.Option(envvar="TOUCHLINE_BRAIN", help="module:Class, or module:function of a plain act(sight).")
    ],
    connection: options.ConnectOptions,
) -> None:
    """Run one robot's brain until the match is over.

    Example: touchline agent --connect tcp/192.168.1.5:7447 --robot cyan1 --brain my_team:Striker
    """
    from robot_agent.__main__ import main

    raise typer.Exit(
        main(["--connect", connection.connect, "--match", connection.match, "--robot", robot, "--brain", brain])
    )
