"""The command lines in the documents and in the help are valid."""

import re
import shlex
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import typer

from touchline.command_line import app

ROOT_COMMAND: Any = typer.main.get_command(app)


def commands(command: Any, path: str = "touchline") -> Iterator[tuple[str, Any]]:
    """Every command by its whole name."""
    yield path, command
    for name, below in getattr(command, "commands", {}).items():
        yield from commands(below, f"{path} {name}")


COMMANDS = dict(commands(ROOT_COMMAND))


def fault(line: str) -> str | None:
    """What is wrong with a command line, or nothing: a command that is not there, an option it does not have."""
    words = shlex.split(line.split("|")[0], comments=True)
    command, rest = ROOT_COMMAND, words[1:]
    while rest and hasattr(command, "commands"):
        name, *rest = rest
        if name not in command.commands:
            return f"{line}: no command {name}"
        command = command.commands[name]
    known = {option for parameter in command.params for option in parameter.opts}
    unknown = [word for word in rest if re.match(r"--\w", word) and word not in known]
    return f"{line}: no option {unknown}" if unknown else None


def test_every_command_line_of_the_readme_can_be_typed(root: Path, fenced: Callable[[str, str], list[str]]) -> None:
    lines = [line for piece in fenced((root / "README.md").read_text("utf-8"), "sh") for line in piece.splitlines()]
    own = [line for line in lines if line.startswith("touchline ")]
    assert len(own) > 8
    assert [said for line in own if (said := fault(line))] == []
    arguments = [match[1] for line in lines if (match := re.match(r'make match ARGS="(.*)"', line))]
    assert [said for words in arguments if (said := fault(f"touchline match {words}"))] == []
    files = re.findall(r"\w+/\w+\.toml", " ".join(arguments))
    assert files
    assert [file for file in files if not (root / file).exists()] == []


@pytest.mark.parametrize("name", [name for name, command in COMMANDS.items() if not hasattr(command, "commands")])
def test_every_command_has_an_example_that_can_be_typed_in_its_help(name: str) -> None:
    found = re.search(r"Example: (.*)", COMMANDS[name].help)
    assert found is not None
    assert found[1].startswith(name)
    assert fault(found[1]) is None


def test_a_command_or_an_option_that_is_not_there_is_found() -> None:
    assert fault("touchline mtach") == "touchline mtach: no command mtach"
    assert fault("touchline coach order cyan --mood hold") is not None
