"""`touchline agent`: one robot's brain, on the host's machine or another."""

import typer

from robot_agent import run
from robot_agent.settings import AgentSettings
from touchline.cli.option_groups import with_option_groups


@with_option_groups
def agent(settings: AgentSettings) -> None:
    """Run one robot's brain until the match is over.

    Example: touchline agent --connect tcp/192.168.1.5:7447 --robot cyan1 --brain my_team:Striker
    """
    raise typer.Exit(run(settings))
