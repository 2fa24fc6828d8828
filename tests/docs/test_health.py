"""docs/networking.md explains each column of the ledger of health and each line of the examination."""

import re
from pathlib import Path

import pytest

from touchline.commands.diagnosis.doctor.machine import MachineFacts, examine_machine
from touchline.commands.diagnosis.health.tables import HEADINGS


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "networking.md").read_text()


def explained(page: str) -> set[str]:
    """The names in the first column of its tables."""
    return {
        name for row in re.findall(r"^\| (`[^|]+) \|", page, re.MULTILINE) for name in re.findall(r"`([^`]+)`", row)
    }


def test_every_column_is_explained(page: str) -> None:
    assert {heading for heading in HEADINGS if heading != "robot"} <= explained(page)


def test_every_line_of_the_examination_is_explained(page: str, root: Path) -> None:
    sources = [path.read_text() for path in (root / "touchline" / "commands" / "diagnosis" / "doctor").glob("*.py")]
    names = {name for source in sources for name in re.findall(r'Finding\(\s*"([a-z ]+)"', source)}
    names |= {finding.name for finding in examine_machine(MachineFacts.of_this_machine())}
    assert {"port", "clock", "round trip"} < names
    assert names <= explained(page)
