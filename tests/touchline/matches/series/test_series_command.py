"""`touchline series`, with short matches in real processes."""

import importlib.util
import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

from recordings.reading.recording import open_recording
from recordings.soccer.stats.match_statistics import figures_of_recording
from schemas.config.match_config import load_match
from schemas.side import Side
from touchline.commands.cli.command_line import app
from touchline.play.play_match import play_match
from touchline.verify.resimulate import verify

GOAL = """
description = "A ball that rolls into magenta's goal."
ball = { x = 10.5, y = 0.0, vx = 5.0 }
robots = [
    { name = "cyan1", side = "cyan", x = 0.0, y = 3.0 },
    { name = "magenta1", side = "magenta", x = 0.0, y = -3.0 },
]
"""


def series(*words: str | Path) -> Result:
    return CliRunner().invoke(app, ["series", *map(str, words)])


def rows(*words: str | Path) -> dict[str, Any]:
    result = series(*words, "--json")
    found: dict[str, Any] = json.loads(result.stdout)
    return found


def test_without_scipy_the_extra_that_brings_it_is_named(match_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    find_spec = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "scipy" else find_spec(name))
    result = series(match_file)
    assert result.exit_code != 0
    output = " ".join(result.output.split())
    assert "intervals need scipy, which is not installed; pip install 'touchline[sim]'" in output


def test_a_match_of_a_series_is_the_match_of_its_seed(match_file: Path) -> None:
    (row,) = rows(match_file, "--seeds", "5")["matches"]
    alone = play_match(load_match(match_file, {"seed": 5}), brain_folder=match_file.parent)
    assert (row["seed"], row["chain"], row["playing_time"]) == (5, alone.chain, pytest.approx(1.0, abs=0.03))


def test_a_brain_that_raises_costs_its_match_only(match_file: Path) -> None:
    words = (match_file, "--seeds", "2", "--both-sides", "--magenta", "few_brains:RaisesInMagenta")
    result = series(*words)
    assert result.exit_code == 1
    assert "1 of 2 matches, 1 failed; in brackets" in result.stdout
    assert "seed 2: failed: magenta1, tick 20: ValueError: no idea (few_brains.py, line " in result.stderr
    found = rows(*words)
    assert [(row["seed"], row["swapped"]) for row in found["matches"]] == [(2, True)]
    assert [(row["seed"], row["swapped"]) for row in found["failed"]] == [(2, False)]


def test_brains_keep_nothing_from_one_match_to_the_next(match_file: Path) -> None:
    found = rows(match_file, "--seeds", "1-3", "--jobs", "1", "--cyan", "few_brains:OnceOnly")
    assert (len(found["matches"]), found["failed"]) == (3, [])


def test_a_recording_of_each_match_has_the_same_figures_and_can_be_verified(match_file: Path, tmp_path: Path) -> None:
    words = ("--seeds", "3", "--both-sides", "--set", "teams.cyan.size=2", "--record", tmp_path / "kept")
    found = rows(match_file, *words)
    files = [tmp_path / "kept" / name for name in ("seed_3.mcap", "seed_3_swapped.mcap")]
    assert sorted((tmp_path / "kept").iterdir()) == sorted(files)
    for row, file in zip(found["matches"], files, strict=True):
        figures = figures_of_recording(open_recording(file))
        assert row["in_play_s"] == figures.in_play_s
        sides = list(Side)[::-1] if row["swapped"] else list(Side)
        field = [robot for robot in figures.robots if not robot.keeper]
        ways = [[robot.clock_distance for robot in field if robot.side == side] for side in sides]
        possession = [figures.sides[side].possession_s or 0.0 for side in sides]
        assert [team["possession_s"] for team in row["teams"]] == possession
        assert [team["field_robots"] for team in row["teams"]] == [1, 0]
        assert [team["field_distance"] for team in row["teams"]] == [sum(way) for way in ways]
        assert sum(map(sum, ways)) > 0
        assert verify(file).identical
    assert "seed_3.mcap: already exists; give another folder" in series(match_file, *words).stderr


def test_a_key_of_the_match_file_is_replaced(match_file: Path) -> None:
    words = (match_file, "--seeds", "1")
    (short,), (longer,) = (rows(*words, *more)["matches"] for more in ([], ["--set", "duration=1.5"]))
    assert (round(short["playing_time"], 1), round(longer["playing_time"], 1)) == (1.0, 1.5)
    assert short["identity"] != longer["identity"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--seeds", "x"], '--seeds is "x"; write a range'),
        (["--jobs", "-1"], "--jobs is -1; give a number"),
        (["--set", "radio.loss"], '--set is "radio.loss"; write a key'),
        (["--set", "seed=4"], "--set seed=4: the seeds are those of --seeds"),
        (["--set", "radio.lost=0.2"], "radio.lost is not known"),
        (["--cyan", "simpel"], 'did you mean "simple"'),
        (["--cyan", "few_brains:Nobody"], "few_brains has no Nobody"),
    ],
)
def test_a_wrong_option_is_one_line_before_any_match(match_file: Path, words: list[str], said: str) -> None:
    result = series(match_file, *words)
    assert result.exit_code == 2
    assert said in result.stderr
    assert len(result.stderr.splitlines()) == 1


@pytest.mark.processes
def test_an_interrupted_series_prints_what_has_been_played(match_file: Path) -> None:
    words = [sys.executable, "-m", "touchline", "series", str(match_file), "--seeds", "1-300", "--jobs", "1"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=dict(os.environ))
    assert process.stdout is not None and process.stderr is not None
    ended = (line for line in process.stderr if line.startswith("2/300 "))
    assert next(ended)
    process.send_signal(signal.SIGTERM)
    output, _ = process.communicate(timeout=60)
    assert process.returncode == 128 + signal.SIGINT
    assert " of 300 matches, " in output and " not played" in output
    assert "share of points" in output


def test_the_worst_match_of_the_first_team_leaves_its_recording(match_file: Path, tmp_path: Path) -> None:
    scene = tmp_path / "goal_of_cyan.toml"
    scene.write_text(GOAL)
    words = ("--scene", scene, "--seeds", "5", "--both-sides", "--failures", "1", "--record", tmp_path / "kept")
    (kept,) = rows(match_file, *words)["failures"]["kept"]
    assert kept["worth"] == -1.0
    teams = open_recording(Path(kept["recording"])).manifest.config.teams
    assert (teams.cyan.name, teams.magenta.name) == ("Still", "Forward")
