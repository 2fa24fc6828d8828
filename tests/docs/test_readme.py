import re
from collections.abc import Callable
from pathlib import Path

import pytest

Fenced = Callable[[str, str], list[str]]


@pytest.fixture(scope="module")
def readme(root: Path) -> str:
    return (root / "README.md").read_text("utf-8")


def test_its_first_ten_lines_say_what_this_is_for_whom_and_how_to_begin(readme: str) -> None:
    lines = readme.splitlines()
    assert "testbed for developing and comparing strategies" in lines[2]
    assert any(line.startswith("make match") for line in lines[:10])


def test_the_first_brain_is_printed_as_it_is_run(readme: str, root: Path, fenced: Fenced) -> None:
    (printed,) = fenced(readme, "python")
    assert printed == (root / "examples" / "first_brain.py").read_text("utf-8")


def test_its_picture_is_a_png_that_loads_quickly(readme: str, root: Path) -> None:
    (shown,) = re.findall(r"^!\[.*\]\((.*)\)$", readme, re.MULTILINE)
    picture = (root / shown).read_bytes()
    assert picture.startswith(b"\x89PNG")
    assert len(picture) < 300_000
