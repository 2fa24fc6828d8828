"""docs/health.md explains each column of the ledger and each line of the examination; its commands can be typed."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
import typer

from touchline.command_line import app
from touchline.doctor.machine import MachineFacts, examine_machine
from touchline.health.tables import HEADINGS


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "health.md").read_text()


def explained(page: str) -> set[str]:
    """The names in the first column of its tables."""
    return {
        name for row in re.findall(r"^\| (`[^|]+) \|", page, re.MULTILINE) for name in re.findall(r"`([^`]+)`", row)
    }


def test_every_column_is_explained(page: str) -> None:
    assert {heading for heading in HEADINGS if heading != "robot"} <= explained(page)


def test_every_line_of_the_examination_is_explained(page: str, root: Path) -> None:
    sources = [path.read_text() for path in (root / "touchline" / "doctor").glob("*.py")]
    names = {name for source in sources for name in re.findall(r'Finding\(\s*"([a-z ]+)"', source)}
    names |= {finding.name for finding in examine_machine(MachineFacts.of_this_machine())}
    assert {"port", "clock", "round trip"} < names
    assert names <= explained(page)


def test_its_command_lines_can_be_typed(page: str, fenced: Callable[[str, str], list[str]]) -> None:
    root = typer.main.get_command(app)
    lines = [line for piece in fenced(page, "sh") for line in piece.splitlines()]
    typed = [line.split("#")[0].split() for line in lines]
    assert len(typed) > 7
    for words in typed:
        words = words[words.index("touchline") + 1 :]  # after a variable of the environment
        command = root.commands[words[0]]  # type: ignore[attr-defined]
        known = {option for parameter in command.params for option in parameter.opts}
        assert [word for word in words if word.startswith("--") and word not in known] == [], words
