"""What moves a robot: a brain in Python, or a program that reads and writes lines."""

from collections.abc import Sequence
from pathlib import Path

from robot_agent.loading.brain_loader import load_brain
from robot_agent.process.stdio.command_line import check_command_line, command_line
from robot_agent.process.stdio.program import StdioProgram
from robot_agent.sdk.contract import Brain, Briefing


def start_robot(
    brain: str,
    stdio: Sequence[str] | None,
    briefing: Briefing,
    beside_match: Path | None = None,
    here: Path | None = None,
) -> Brain:
    """The brain `module:Class`, or the running program of the command line `stdio`, where one is given.

    Raises:
        TouchlineError: the brain cannot be built, or there is no such program.
    """
    if not stdio:
        return load_brain(brain, briefing, beside_match, here)
    check_command_line("stdio", stdio, beside_match)
    return StdioProgram(command_line(stdio, beside_match), briefing)


def end_robot(brain: Brain | None) -> None:
    """End the program of a robot; a brain in this process needs no end."""
    if isinstance(brain, StdioProgram):
        brain.close()
