"""The name that was given to the recorder of a split recording, in the commands that read recordings."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from recordings.container.numbering import numbered_files
from recordings.recorder.file_limits import FileLimits
from schemas.config.match_config import load_match
from touchline.command_line import app


@pytest.fixture(scope="module")
def split(tmp_path_factory: pytest.TempPathFactory, match_recorder: Callable[..., None]) -> Path:
    path = tmp_path_factory.mktemp("split") / "match.mcap"
    teams = {"teams.cyan.size": 1, "teams.magenta.size": 1}
    config = load_match(None, {"seed": 3, "duration": 10.0, **teams})
    match_recorder(path, config, until=2.0, limits=FileLimits(duration=0.6))
    assert len(numbered_files(path)) == 4
    return path


def run(*words: str | Path) -> Any:
    done = CliRunner().invoke(app, [str(word) for word in words], prog_name="touchline")
    assert done.exit_code == 0, done.output
    return done.stdout


def test_info_describes_all_files(split: Path) -> None:
    facts = json.loads(run("info", split, "--json"))
    assert (facts["tick"], facts["duration"]) == (100, 2.0)
    assert {key["key"]: key["messages"] for key in facts["keys"]}["world"] == 101


def test_stats_measure_all_files(split: Path) -> None:
    assert json.loads(run("stats", split, "--json"))["coverage"]["worlds"] == 101


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_verify_compares_the_ticks_of_all_files(split: Path, jobs: str) -> None:
    verdict = json.loads(run("verify", split, "--jobs", jobs, "--json"))
    assert (verdict["identical"], verdict["ticks"]) == (True, 101)


def test_export_writes_the_messages_of_all_files(split: Path, tmp_path: Path) -> None:
    exported = json.loads(run("export", split, "--to", "csv", "--out", tmp_path / "tables", "--json"))
    assert exported["written"]["ball.csv"] == 101


def test_filter_and_diff_read_all_files(split: Path, tmp_path: Path) -> None:
    run("filter", split, "--out", tmp_path / "part.mcap", "--from", "0.5", "--to", "1.5")
    run("filter", split, "--out", tmp_path / "whole.mcap")
    assert run("diff", split, tmp_path / "whole.mcap").startswith("identical")
    assert run("diff", split, tmp_path / "part.mcap", "--from", "0.5", "--to", "1.5").startswith("identical")


def test_recover_repairs_each_file(split: Path) -> None:
    assert [line.split(",")[0] for line in run("recover", split).splitlines()] == [
        f"{file}: intact" for file in numbered_files(split)
    ]
