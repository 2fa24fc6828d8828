"""Every row of the seed's features and defects that concerns the world has a test that names it."""

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest


@pytest.fixture(scope="module")
def parity(root: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location("parity", root / "docs" / "parity.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_feature_and_every_defect_is_named_by_a_test(parity: ModuleType) -> None:
    asked = [*(("row", row) for row in parity.ROWS), *(("defect", defect) for defect in parity.DEFECTS)]
    named = parity.named()
    assert [which for which in asked if which not in named] == []


def test_the_page_is_fresh(parity: ModuleType, root: Path) -> None:
    written = (root / "docs" / "parity.md").read_text("utf-8")
    assert written == parity.page(), "run: .venv/bin/python docs/parity.py > docs/parity.md"


def test_rows_are_read_from_a_docstring(parity: ModuleType) -> None:
    said = "Rows 7 and 17, and defect 4 of section 14; a row of trees is none."
    assert list(parity.words_of(said)) == [("row", 7), ("row", 17), ("defect", 4)]
