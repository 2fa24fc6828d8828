"""The messages that docs/networking.md explains are those that the programs print."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ("schemas", "runtime", "sim_host", "robot_agent", "touchline")
TABLE = (
    (ROOT / "docs" / "networking.md").read_text().partition("## When a robot does not join")[2].partition("\n## ")[0]
)
MESSAGES = re.findall(r"^\| `([^`]+)` \|", TABLE, re.MULTILINE)
FIELD = "\0"
"""Stands for what is filled in, `…` in the document."""


@pytest.fixture(scope="module")
def texts() -> list[str]:
    """All texts in the code, with a field for whatever is filled in; documentation is not among them."""
    return [text for package in PACKAGES for file in (ROOT / package).rglob("*.py") for text in texts_of(file)]


def texts_of(file: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.JoinedStr):
            parts = (part.value if isinstance(part, ast.Constant) else FIELD for part in node.values)
            yield "".join(map(str, parts))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and "\n" not in node.value:
            yield node.value


def test_the_table_has_messages() -> None:
    assert len(MESSAGES) > 10


@pytest.mark.parametrize("message", MESSAGES)
def test_a_message_of_the_table_is_one_of_the_code(texts: list[str], message: str) -> None:
    wanted = re.compile(".*".join(re.escape(part.strip()) for part in message.split("…")))
    assert any(wanted.search(text) for text in texts), message
