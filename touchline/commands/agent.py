"""`touchline agent`: one robot's brain or program, on the host's machine or another."""

import typer

from robot_agent import run
from robot_agent.process.settings import AgentOptions, AgentSettings
from schemas.errors import TouchlineError
from touchline.commands.cli import options
from touchline.commands.cli.option_groups import with_option_groups


@with_option_groups
def agent(settings: AgentOptions, stdio: options.StdioProgram = None) -> None:
    """Run one robot's brain until the match is over, or its program of lines.

    Example: touchline agent --connect tcp/192.168.1.5:7447 --robot cyan1 --brain my_team:Striker
    """
    if bool(settings.brain) == (stdio is not None):
        raise TouchlineError("a robot has a brain or a program; give --brain module:Class or --stdio")
    raise typer.Exit(run(AgentSettings(**dict(settings), stdio=options.program_of(stdio))))
