"""`touchline agent`: one robot's brain or program, on the host's machine or another."""

from typing import Annotated, Any

import typer

from robot_agent import run
from robot_agent.settings import AgentSettings
from schemas.errors import TouchlineError
from touchline.cli import options
from touchline.cli.option_groups import FieldsOf, from_options, with_option_groups

_SHARED = tuple(name for name in AgentSettings.model_fields if name != "stdio")


@with_option_groups
def agent(
    stdio: options.StdioProgram = None, *, settings: Annotated[dict[str, Any], FieldsOf(AgentSettings, *_SHARED)]
) -> None:
    """Run one robot's brain until the match is over, or its program of lines.

    Example: touchline agent --connect tcp/192.168.1.5:7447 --robot cyan1 --brain my_team:Striker
    """
    if bool(settings.get("brain")) == (stdio is not None):
        raise TouchlineError("a robot has a brain or a program; give --brain module:Class or --stdio")
    raise typer.Exit(run(from_options(AgentSettings, **settings, stdio=options.program_of(stdio))))
