"""The commands that read recordings read all parts of one."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from recordings.container.parts import parts_of
from schemas.config.match_config import load_match
from schemas.config.settings import RecordOptions
from touchline.commands.cli.command_line import app


@pytest.fixture(scope="module")
def parted(tmp_path_factory: pytest.TempPathFactory, match_recorder: Callable[..., None]) -> Path:
    path = tmp_path_factory.mktemp("parts") / "match.mcap"
    teams = {"teams.cyan.size": 1, "teams.magenta.size": 1}
    config = load_match(None, {"seed": 3, "duration": 10.0, **teams})
    match_recorder(path, config, until=2.0, options=RecordOptions(part_duration=0.6))
    assert len(parts_of(path)) == 4
    return path


def run(*words: str | Path) -> Any:
    done = CliRunner().invoke(app, [str(word) for word in words], prog_name="touchline")
    assert done.exit_code == 0, done.output
    return done.stdout


def test_info_describes_all_parts(parted: Path) -> None:
    facts = json.loads(run("info", parted, "--json"))
    assert (facts["tick"], facts["duration"]) == (100, 2.0)
    assert {key["key"]: key["messages"] for key in facts["keys"]}["world"] == 101


def test_stats_measure_all_parts(parted: Path) -> None:
    assert json.loads(run("stats", parted, "--json"))["coverage"]["worlds"] == 101


def test_export_writes_the_messages_of_all_parts(parted: Path, tmp_path: Path) -> None:
    exported = json.loads(run("export", parted, "--format", "csv", "--out", tmp_path / "tables", "--json"))
    assert exported["written"]["ball.csv"] == 101


def test_filter_and_diff_read_all_parts(parted: Path, tmp_path: Path) -> None:
    run("filter", parted, "--out", tmp_path / "part.mcap", "--from", "0.5", "--to", "1.5")
    run("filter", parted, "--out", tmp_path / "whole.mcap")
    assert run("diff", parted, tmp_path / "whole.mcap").startswith("identical")
    assert run("diff", parted, tmp_path / "part.mcap", "--from", "0.5", "--to", "1.5").startswith("identical")


def test_recover_repairs_each_part(parted: Path) -> None:
    assert [line.split(",")[0] for line in run("recover", parted).splitlines()] == [
        f"{file}: intact" for file in parts_of(parted)
    ]
