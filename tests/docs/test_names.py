"""What the documents name is there: functions, files, the targets of links."""

import importlib
import re
from pathlib import Path
from typing import Any

import pytest

DOCUMENTS = (
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "docs/protocol.md",
    "docs/coach.md",
    "docs/recordings.md",
    "docs/physics.md",
    "docs/parity.md",
    "docs/decisions.md",
    "docs/performance.md",
    "docs/scheduling.md",
)
PACKAGES = ("schemas", "sim_host", "robot_agent", "coach_gateway", "recordings", "touchline")
FILES = r"`([\w.]+/[\w./]*\.\w+)`"


def resolve(name: str) -> Any:
    """The object of a dotted name that begins with a package."""
    parts = name.split(".")
    for length in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:length]))
        except ModuleNotFoundError:
            continue
        for part in parts[length:]:
            found = getattr(found, part)
        return found
    raise AssertionError(f"{name} is nowhere")


def names_in(document: Path) -> list[str]:
    return re.findall(rf"`((?:{'|'.join(PACKAGES)})\.[\w.]*\w)`", document.read_text("utf-8"))


@pytest.mark.parametrize("document", DOCUMENTS)
def test_every_module_class_and_function_that_is_named_is_there(document: str, root: Path) -> None:
    missing = []
    for name in names_in(root / document):
        try:
            resolve(name)
        except AttributeError:
            missing.append(name)
    assert missing == []


def test_the_architecture_names_the_code(root: Path) -> None:
    assert len(names_in(root / "ARCHITECTURE.md")) > 35


@pytest.mark.parametrize("document", DOCUMENTS)
def test_every_file_that_is_named_is_there(document: str, root: Path) -> None:
    named = re.findall(FILES, (root / document).read_text("utf-8"))
    assert [name for name in named if not (root / name).exists()] == []


@pytest.mark.parametrize("document", DOCUMENTS)
def test_every_link_leads_somewhere(document: str, root: Path) -> None:
    text = (root / document).read_text("utf-8")
    headings = {re.sub(r"[^\w\- ]", "", line.lstrip("# ").lower()).replace(" ", "-") for line in text.splitlines()}
    for target in re.findall(r"\]\(([^)]+)\)", text):
        if target.startswith("#"):
            assert target[1:] in headings
        elif not target.startswith("https://"):
            assert ((root / document).parent / target).exists(), target
