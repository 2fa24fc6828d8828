"""The comparison with earlier systems: every row has a status and, where it works, a test that exists."""

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest


@pytest.fixture(scope="module")
def parity(generator: Callable[[str], ModuleType]) -> ModuleType:
    return generator("parity")


def test_every_reference_names_one_test_or_benchmark_that_exists(parity: ModuleType) -> None:
    rows = [row for rows in parity.load().values() for row in rows]
    assert [fault for row in rows for one in row["shown"] if (fault := parity.fault(one))] == []


def test_every_feature_and_defect_has_a_status_and_what_works_is_tested(parity: ModuleType) -> None:
    rows = parity.load()
    assert (len(rows["feature"]), len(rows["defect"])) == (54, 18)
    assert {row["status"] for row in rows["feature"]} <= {"works", "partly", "missing"}
    assert {row["status"] for row in rows["defect"]} <= {"avoided", "present"}
    tested = [row for row in rows["feature"] + rows["defect"] if row["status"] not in ("missing", "present")]
    assert [row for row in tested if not any(one.startswith("test_") for one in row["shown"])] == []


def test_every_feature_names_where_it_is_found_and_what_is_not_whole_says_what_is_missing(parity: ModuleType) -> None:
    features = parity.load()["feature"]
    sources = {"paper", "simatch", "league", "simatch lacks it", "league wants it"}
    assert [row["feature"] for row in features if not row["from"] or set(row["from"]) - sources] == []
    assert [row["feature"] for row in features if row["status"] != "works" and not row.get("note")] == []
    assert len({row["feature"] for row in features}) == len(features)


def test_the_page_is_fresh(parity: ModuleType, root: Path) -> None:
    written = (root / "docs" / "parity.md").read_text("utf-8")
    assert written == parity.page(), "run: .venv/bin/python docs/generate/parity.py > docs/parity.md"


def test_a_reference_to_a_test_that_was_renamed_is_reported_with_the_nearest_name(parity: ModuleType) -> None:
    reported = parity.fault("test_parity.py::test_the_page_is_freshh")
    assert reported == "no test test_parity.py::test_the_page_is_freshh; perhaps test_the_page_is_fresh"
    assert parity.fault("test_nowhere.py") == "no file test_nowhere.py"
