"""The command line of a program in a match file: where its files lie, and whether they are there."""

import os
import shutil
from collections.abc import Sequence
from pathlib import Path

from robot_agent.loading.brain_folders import BrainFolders
from schemas.errors import TouchlineError

_SCRIPTS = (".cjs", ".jl", ".js", ".lua", ".mjs", ".pl", ".py", ".rb", ".sh", ".ts")
"""Ends of the names of files that an interpreter runs."""


def command_line(command: Sequence[str], beside_match: Path | None = None) -> tuple[str, ...]:
    """A command line for any working folder: the files that it names have absolute paths.

    They are looked for in `beside_match`, the folder of the match file, and then in the current directory. A program
    without a slash in its name is one of PATH.
    """
    program, *arguments = command
    folders = BrainFolders(beside_match)
    if os.sep in program:
        program = str(folders.find(program) or Path(program).absolute())
    return (program, *(str((word and folders.find(word)) or word) for word in arguments))


def check_command_line(key: str, command: Sequence[str], beside_match: Path | None = None) -> None:
    """Check that a program can be started.

    Raises:
        TouchlineError: it does not exist, or the script that it runs does not; the message begins with `key`.
    """
    if not command:
        raise TouchlineError(f'{key} is empty; write it as ["program", "argument"]')
    program, *arguments = command_line(command, beside_match)
    folders = BrainFolders(beside_match)
    if shutil.which(program) is None:
        is_file = os.sep in program and Path(program).is_file()
        remedy = "is not executable; chmod +x it" if is_file else f"is not a program here or {folders}; give its path"
        raise TouchlineError(f'{key} begins with "{command[0]}", which {remedy}')
    script = arguments[0] if arguments else ""
    if script.endswith(_SCRIPTS) and not script.startswith("-") and not Path(script).exists():
        raise TouchlineError(f'{key} names "{command[1]}", which is not {folders}; put the file there')
