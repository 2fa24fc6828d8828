"""The command lines in the help are valid, and a wrong one is found."""

import re

import pytest

from support.command_lines import commands, fault

COMMANDS = dict(commands())


@pytest.mark.parametrize("name", [name for name, command in COMMANDS.items() if not hasattr(command, "commands")])
def test_every_command_has_an_example_that_can_be_typed_in_its_help(name: str) -> None:
    found = re.search(r"Example: (.*)", COMMANDS[name].help)
    assert found is not None
    assert found[1].startswith(name)
    assert fault(found[1]) is None


@pytest.mark.parametrize(
    "line", ["touchline mtach", "touchline coach order cyan --mood hold", "touchline coach order cyan --mode hodl"]
)
def test_a_command_an_option_or_a_choice_that_is_not_there_is_found(line: str) -> None:
    assert fault(line) is not None
