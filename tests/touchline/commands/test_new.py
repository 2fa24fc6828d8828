"""`touchline new`: the folder of a new team."""

import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from schemas.config.match_config import load_match
from schemas.side import Side
from support.brisk import BRISK
from touchline.commands.cli.command_line import app
from touchline.play.play_match import play_match

run = CliRunner()


@pytest.mark.slow
def test_a_new_team_plays_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    made = run.invoke(app, ["new", "my_team"])
    assert made.exit_code == 0, made.output
    assert "cd my_team; touchline match match.toml" in made.output
    folder = tmp_path / "my_team"
    config = load_match(folder / "match.toml", {"duration": 6.0, "rules": str(BRISK)})
    assert config.team(Side.CYAN).brain == "my_team:MyTeam"
    touched: set[str] = set()
    outcome = play_match(config, watch=lambda tick: touched.update(tick.world.get("touches", ())), brain_folder=folder)
    assert outcome.time > 6.0
    assert {robot for robot in touched if robot.startswith("cyan")}


@pytest.mark.slow
def test_its_own_tests_pass(tmp_path: Path) -> None:
    assert run.invoke(app, ["new", "red_lions", "--in", str(tmp_path)]).exit_code == 0
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"]
    done = subprocess.run(words, capture_output=True, text=True, cwd=tmp_path / "red_lions")
    assert done.returncode == 0, done.stdout


def test_its_files_bear_the_name_of_the_team(tmp_path: Path) -> None:
    assert run.invoke(app, ["new", "red_devils", "--in", str(tmp_path)]).exit_code == 0
    folder = tmp_path / "red_devils"
    assert sorted(file.name for file in folder.iterdir()) == [
        "README.md",
        "match.toml",
        "pytest.ini",
        "red_devils.py",
        "test_red_devils.py",
    ]
    assert all("eam_name" not in file.read_text() and "TeamName" not in file.read_text() for file in folder.iterdir())
    assert "class RedDevils(Player):" in (folder / "red_devils.py").read_text()


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("My-Team", "write lower-case letters, digits and _"),
        ("class", "write lower-case letters, digits and _"),
        ("sys", "another module has (built-in); choose another"),
        ("json", "json/__init__.py); choose another"),
        ("robot_agent", "robot_agent/__init__.py); choose another"),
    ],
)
def test_a_name_that_is_none_for_a_module_is_refused_in_one_line(tmp_path: Path, name: str, reason: str) -> None:
    refused = run.invoke(app, ["new", name, "--in", str(tmp_path)])
    assert refused.exit_code == 2
    assert reason in refused.output.replace("\n", "")
    assert list(tmp_path.iterdir()) == []


def test_a_team_may_have_the_name_of_another_folder_on_the_path(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "before" / "far_team").mkdir(parents=True)
    monkeypatch.syspath_prepend(tmp_path / "before")
    assert run.invoke(app, ["new", "far_team", "--in", str(tmp_path)]).exit_code == 0


def test_a_folder_that_exists_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "my_team").mkdir()
    refused = run.invoke(app, ["new", "my_team", "--in", str(tmp_path)])
    assert refused.exit_code == 2
    assert "exists already" in refused.output
    assert list((tmp_path / "my_team").iterdir()) == []


def test_a_folder_that_cannot_be_made_is_named_in_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    refused = run.invoke(app, ["new", "their_team", "--in", str(tmp_path / "file" / "below")])
    assert refused.exit_code == 2
    assert "file/below/their_team: Not a directory; choose another folder with --in" in refused.output
