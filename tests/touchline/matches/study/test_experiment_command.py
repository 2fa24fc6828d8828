import json
import logging
from pathlib import Path

import pytest
from typer.testing import CliRunner

pytest.importorskip("scipy", reason="experiments need the extra study")
pytest.importorskip("pyarrow", reason="experiments need the extra study")

from recordings.reading.recording import open_recording
from support.brisk import BRISK
from touchline.commands import experiment
from touchline.commands.cli.command_line import app
from touchline.matches.study.study_folder import read_study

STUDY = f"""
seeds = "1-2"
both_sides = false
responses = ["distance"]
[settings]
duration = 1.0
rules = "{BRISK}"
teams.cyan.size = 1
teams.magenta.size = 1
"""


def run(*arguments: str | Path) -> tuple[int, str]:
    result = CliRunner().invoke(app, ["experiment", *map(str, arguments)])
    return result.exit_code, result.output if result.exception is None else f"{result.output}{result.exception}"


def test_a_study_file_alone_runs_the_study_and_its_folder_is_reproduced(tmp_path: Path) -> None:
    file, folder = tmp_path / "try.toml", tmp_path / "out"
    file.write_text(STUDY)
    status, text = run(file, "--out", folder, "--jobs", "1")
    assert (status, "report" in text) == (0, True)
    status, text = run("reproduce", folder, "--jobs", "1")
    assert status == 0
    assert "the table of results is the same to the byte" in text


@pytest.mark.parametrize("responses", ['["distance", "goal"]', '["goal"]'])
def test_a_response_that_no_match_has_is_refused_after_the_first_seed(tmp_path: Path, responses: str) -> None:
    (tmp_path / "try.toml").write_text(STUDY.replace('["distance"]', responses).replace('"1-2"', '"1-60"'))
    status, text = run(tmp_path / "try.toml", "--out", tmp_path / "out", "--jobs", "1")
    assert status == 2
    assert 'No match has a figure goal; did you mean "goals"?' in text
    assert not (tmp_path / "out" / "index.html").exists()


def test_no_match_fails_by_a_first_response_that_was_counted_in_none(tmp_path: Path) -> None:
    (tmp_path / "try.toml").write_text(STUDY.replace('"distance"', '"first.fouls.charging"'))
    status, text = run(tmp_path / "try.toml", "--out", tmp_path / "out", "--jobs", "1", "--failures", "1")
    assert status == 0, text
    assert "no failures" in text.splitlines()


def test_matplotlib_does_not_say_that_it_builds_a_cache_of_fonts() -> None:
    pytest.importorskip("touchline.matches.study.plots")
    assert not logging.getLogger("matplotlib.font_manager").isEnabledFor(logging.WARNING)


def test_json_has_a_line_for_each_match_on_stderr_and_the_summary_on_stdout(tmp_path: Path) -> None:
    file, folder = tmp_path / "try.toml", tmp_path / "out"
    file.write_text(STUDY)
    words = ["experiment", str(file), "--out", str(folder), "--jobs", "1", "--failures", "1", "--json"]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.exception
    summary = json.loads(result.stdout)
    assert (summary["played"], summary["seeds"], summary["failed"]) == (2, [1, 2], [])
    assert summary["folder"] == str(folder)
    lines = [json.loads(line) for line in result.stderr.splitlines()]
    told = [(line["done"], line["total"], line["match_failed"]) for line in lines]
    assert told == [(1, 2, False), (2, 2, False), (1, 1, False)]
    assert lines[0]["match"].startswith("cell 1, seed 1: cyan ")
    table = read_study(folder).table.sort_values("distance")
    least, most = table["distance"]
    (kept,) = summary["failures"]["kept"]
    assert kept["worth"] == least < most
    assert open_recording(Path(kept["recording"])).manifest.config.seed == table["seed"].iloc[0]


def test_a_package_that_is_missing_is_named_with_its_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(experiment, "NEEDED", ("no_such_package",))
    status, text = run("verify", tmp_path)
    assert status != 0
    assert "experiments need no_such_package, which is not installed; pip install 'touchline[study]'" in text


def test_a_folder_without_a_study_is_refused(tmp_path: Path) -> None:
    status, text = run("verify", tmp_path)
    assert status != 0
    assert "give the folder of a study that was played" in text
