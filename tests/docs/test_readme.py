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
    assert len(lines) <= 120
    assert "testbed for developing and comparing strategies" in lines[2]
    assert any(line.startswith("make match") for line in lines[:10])


def test_the_first_brain_is_printed_as_it_is_run(readme: str, root: Path, fenced: Fenced) -> None:
    (printed,) = fenced(readme, "python")
    assert printed == (root / "examples" / "first_brain.py").read_text("utf-8")


def test_every_make_target_that_it_names_is_there(readme: str, root: Path) -> None:
    targets = re.findall(r"^(\w+):", (root / "Makefile").read_text("utf-8"), re.MULTILINE)
    named = re.findall(r"^make (\w+)|`make (\w+)`", readme, re.MULTILINE)
    assert {"match", "test"} <= {first or second for first, second in named} <= set(targets)


def test_its_tree_names_every_package_and_nothing_that_is_not_there(readme: str, root: Path, fenced: Fenced) -> None:
    tree = next(piece for piece in fenced(readme, "") if piece.startswith("schemas/"))
    named = [line.split("/")[0] for line in tree.splitlines()]
    packages = [folder.parent.name for folder in root.glob("*/__init__.py")]
    assert sorted(set(packages) - set(named)) == []
    assert [name for name in named if not (root / name).is_dir()] == []


def test_the_picture_is_a_png_that_loads_at_once(root: Path) -> None:
    picture = (root / "docs" / "images" / "match.png").read_bytes()
    assert picture.startswith(b"\x89PNG")
    assert len(picture) < 300_000
