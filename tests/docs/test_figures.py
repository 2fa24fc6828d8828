"""The page on simplifications and real figures: its figures are from runs, and the numbers that it names exist."""

import re
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

from schemas.config.quantity import meanings
from schemas.config.sections import SECTIONS


@pytest.fixture(scope="module")
def figures(generator: Callable[[str], ModuleType]) -> ModuleType:
    return generator("figures")


@pytest.fixture(scope="module")
def text(root: Path) -> str:
    return (root / "docs" / "simplified.md").read_text("utf-8")


def test_the_figures_are_those_of_runs(text: str, figures: ModuleType) -> None:
    assert text == figures.filled(text), "run: .venv/bin/python docs/generate/figures.py"


def test_every_figure_stands_in_the_page(text: str, figures: ModuleType) -> None:
    assert set(re.findall(r"<!--=(\w+)-->", text)) == set(figures.FIGURES)


def test_every_number_that_it_names_is_one_of_a_profile(text: str) -> None:
    named = re.findall(rf"`({'|'.join(SECTIONS)})\.(\w+)`", text)
    assert len(named) > 10
    for section, key in named:
        assert key in meanings(SECTIONS[section]), f"{section}.{key}"


def test_every_row_has_all_its_columns(text: str) -> None:
    assert [line for line in text.splitlines() if line.startswith("|") and line.count("|") != 5] == []
