"""Judges command lines of the documents and of help texts by the program's own parser, without running them."""

import re
import shlex
from collections.abc import Iterator
from typing import Any

import typer

from touchline.commands.cli.command_line import app

ROOT_COMMAND: Any = typer.main.get_command(app)


def commands(command: Any = ROOT_COMMAND, path: str = "touchline") -> Iterator[tuple[str, Any]]:
    """Every command by its whole name."""
    yield path, command
    for name, below in getattr(command, "commands", {}).items():
        yield from commands(below, f"{path} {name}")


def fault(line: str) -> str | None:
    """What is wrong with a command line, or None: no such command or option, a missing argument, a word of no choice.

    Files that it names need not be there.
    """
    plain = re.sub(r'"\$\(.*?\)"', "VALUE", line)  # what a shell would fill in
    words = shlex.split(plain.split(" | ")[0].split(" > ")[0], comments=True)
    command, rest = ROOT_COMMAND, words[1:]
    while rest and hasattr(command, "commands") and rest[0] not in ("--help", "--version"):
        name, *rest = rest
        if name not in command.commands:
            return f"{line}: no command {name}"
        command = command.commands[name]
    try:
        command.make_context(command.name, list(rest))
    except typer.TyperException as error:
        said = error.format_message()
        return None if "does not exist" in said else f"{line}: {said}"
    except typer.Exit:
        return None
    return None
