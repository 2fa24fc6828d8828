"""The pages on simplifications and on real figures: their figures are those of runs, and what they name exists."""

import re
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

from schemas.config.quantity import meanings
from schemas.config.sections import SECTIONS

PAGES = ("simplified.md", "sim_to_real.md")


@pytest.fixture(scope="module")
def figures(generator: Callable[[str], ModuleType]) -> ModuleType:
    return generator("figures")


@pytest.mark.parametrize("page", PAGES)
def test_the_figures_are_those_of_runs(page: str, root: Path, figures: ModuleType) -> None:
    text = (root / "docs" / page).read_text("utf-8")
    assert text == figures.filled(text), "run: .venv/bin/python docs/generate/figures.py"


def test_every_figure_stands_in_a_page(root: Path, figures: ModuleType) -> None:
    shown = {name for page in PAGES for name in re.findall(r"<!--=(\w+)-->", (root / "docs" / page).read_text("utf-8"))}
    assert shown == set(figures.FIGURES)


@pytest.mark.parametrize("page", PAGES)
def test_every_number_that_a_page_names_is_one_of_a_profile(page: str, root: Path) -> None:
    text = (root / "docs" / page).read_text("utf-8")
    named = re.findall(rf"`({'|'.join(SECTIONS)})\.(\w+)`", text)
    assert page != "simplified.md" or len(named) > 10
    for section, key in named:
        assert key in meanings(SECTIONS[section]), f"{section}.{key}"


def test_every_row_has_all_its_columns(root: Path) -> None:
    for page in PAGES:
        for line in (root / "docs" / page).read_text("utf-8").splitlines():
            assert not line.startswith("|") or line.count("|") == 5, line


def test_the_pages_are_linked(root: Path) -> None:
    physics, readme = ((root / name).read_text("utf-8") for name in ("docs/physics.md", "README.md"))
    for page in PAGES:
        assert page in physics and f"docs/{page}" in readme
