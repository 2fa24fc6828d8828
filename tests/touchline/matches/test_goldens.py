"""Matches that were played once and for all, played again: every score, figure and hash chain is the same.

The data are what the commands print with --json, and the studies that ship. Identities are left out: they change with
every field of a match file.
"""

import csv
import html
import json
import re
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from touchline.commands.cli.command_line import app

pytest.importorskip("scipy", reason="intervals need the extra sim")

ROOT = Path(__file__).parents[3]
DATA = Path(__file__).parent / "data"
_LEFT_OUT = ("identity", "recording", "evidence")
_DIGITS = 6


def printed(*words: str | Path) -> str:
    result = CliRunner().invoke(app, [*map(str, words)])
    assert result.exit_code == 0, result.output
    return result.stdout


def without_identities(content: Any) -> Any:
    """Content of JSON without what depends on more than the matches, its numbers rounded."""
    if isinstance(content, dict):
        return {key: without_identities(value) for key, value in content.items() if key not in _LEFT_OUT}
    if isinstance(content, list):
        return [without_identities(one) for one in content]
    return round(content, _DIGITS) if isinstance(content, float) else content


def golden(name: str) -> Any:
    return json.loads((DATA / name).read_text("utf-8"))


def rows_of(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return [{key: value for key, value in row.items() if key not in _LEFT_OUT} for row in csv.DictReader(file)]


def text_of(page: Path) -> list[str]:
    """The words of a report, without pictures and versions."""
    body = page.read_text("utf-8").partition("<h2>Versions</h2>")[0]
    without_pictures = re.sub(r"<(svg|style)\b.*?</\1>", " ", body, flags=re.DOTALL)
    return html.unescape(re.sub(r"<[^>]*>", " ", without_pictures)).split()


@pytest.mark.long
def test_a_series_is_the_one_that_was_played_before() -> None:
    teams = ("--cyan", "simple", "--magenta", "nubot")
    found = printed("series", *teams, "--seeds", "1-2", "--both-sides", "--duration", "10", "--json")
    assert without_identities(json.loads(found)) == golden("series.json")


@pytest.mark.slow
def test_a_drill_is_the_one_that_was_played_before() -> None:
    found = printed("drill", "one_against_keeper", "--seeds", "1-4", "--json")
    assert without_identities(json.loads(found)) == golden("drill.json")


@pytest.mark.long
@pytest.mark.timeout(1800)
def test_the_cup_that_ships_is_the_one_that_was_played_before(tmp_path: Path) -> None:
    found = printed("tournament", ROOT / "matches" / "cup.toml", "--out", tmp_path / "cup", "--json")
    assert without_identities(json.loads(found)) == golden("cup.json")


@pytest.mark.long
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("name", ["noise", "radio", "sides"])
def test_a_study_that_ships_is_the_one_that_was_played_before(name: str, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow", reason="experiments need the extra study")
    printed("experiment", "run", ROOT / "studies" / f"{name}.toml", "--out", tmp_path)
    published = ROOT / "studies" / name
    assert rows_of(tmp_path / "results.csv") == rows_of(published / "results.csv")
    assert text_of(tmp_path / "report.html") == text_of(published / "report.html")
