"""The process of one robot: its brain, or its team's own program."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from robot_agent.process.settings import AgentSettings
from schemas.side import Side
from touchline.launch.confinement.robot_confinement import Confinement
from touchline.launch.processes.process_table import (
    COMMON_ENVIRONMENT,
    PROCESSES,
    Process,
    ProcessKind,
    library_process,
)

# A fixed hash seed: a brain that iterates over a set of strings has the same order in every run.
ROBOT_ENVIRONMENT = {**COMMON_ENVIRONMENT, "PYTHONHASHSEED": "0"}
"""Environment of every robot, without its own name."""


def robot_process(
    name: str, settings: AgentSettings, side: Side, command: Sequence[str], folder: Path, confinement: Confinement
) -> Process:
    """The brain of a robot, those of all robots of a side, or a team's own program for a robot.

    The program reads what the settings say from its environment.

    Args:
        name: of the process: the robot's, or the side's.
        settings: with paths that are valid in this process's folder; the robot works in its confinement's folder.
        command: the team's own program, with absolute paths; empty for a brain.
    """
    if settings.credentials is not None:
        confinement = replace(confinement, credentials=settings.credentials.absolute())
    found = {"credentials": confinement.readable_credentials, "launch_folder": settings.launch_folder or Path.cwd()}
    settings = settings.model_copy(update=found)
    credentials = str(settings.credentials.resolve()) if settings.credentials is not None else None
    environment = {
        **ROBOT_ENVIRONMENT,
        "TOUCHLINE_CONNECT": settings.connect,
        "TOUCHLINE_MATCH": settings.match,
        "TOUCHLINE_ROBOT": settings.robot,
        "TOUCHLINE_SIDE": side.value,
        "TOUCHLINE_LAUNCH_TOKEN": settings.launch_token,
        "TOUCHLINE_CREDENTIALS": credentials,
    }
    given = {name: value for name, value in environment.items() if value is not None}
    if command:
        restarts = PROCESSES[ProcessKind.AGENT].restarts
        return Process(name, ProcessKind.AGENT, tuple(command), given, restarts, confinement=confinement)
    process = library_process(name, ProcessKind.AGENT, settings, folder, given)
    return replace(process, confinement=confinement)
