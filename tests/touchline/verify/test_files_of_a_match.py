"""A recording holds the scene and the profile of its match: it needs none of the files that they were read from."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import pytest
from typer.testing import CliRunner

from recordings.reading.recording import Recording, open_recording
from schemas.config.match_config import load_match
from schemas.side import Side
from touchline.commands.cli.command_line import app
from touchline.verify.compare_brain import compare_brain
from touchline.verify.resimulate import verify

NUBOT = "robot_agent.teams.nubot:NuBot"

SCENE = """
description = "Two against one, and a robot that stands still."
robots = [
    { name = "anna", side = "cyan", x = -2.0, y = 0.5 },
    { name = "bert", side = "cyan", x = -4.0, y = -1.0 },
    { name = "cleo", side = "magenta", x = 3.0, y = 0.0 },
    { name = "post", side = "magenta", x = 1.0, y = 2.0, agent = false },
]
"""
ANOTHER_SCENE = """
description = "One alone."
robots = [{ name = "zoe", side = "cyan", x = 0.0, y = 3.0 }]
"""
PROFILE = 'extends = "msl"\n[drive]\nmax_speed = { value = 1.5, unit = "m/s", origin = "ours" }\n'
ANOTHER_PROFILE = PROFILE.replace("1.5", "3.5")


def delete(folder: Path) -> None:
    (folder / "mine.toml").unlink()
    (folder / "slow.toml").unlink()


def rewrite(folder: Path) -> None:
    (folder / "mine.toml").write_text(ANOTHER_SCENE)
    (folder / "slow.toml").write_text(ANOTHER_PROFILE)


@pytest.fixture
def from_files(tmp_path: Path, match_recorder: Callable[..., None]) -> Path:
    """A recording of a second of a match whose scene and profile were read from files beside it."""
    (tmp_path / "mine.toml").write_text(SCENE)
    (tmp_path / "slow.toml").write_text(PROFILE)
    files = {"scene": str(tmp_path / "mine.toml"), "profile": str(tmp_path / "slow.toml")}
    config = load_match(None, {"seed": 7, "teams.magenta.brain": NUBOT, **files})
    match_recorder(tmp_path / "match.mcap", config, until=1.0)
    return tmp_path / "match.mcap"


def info(path: Path) -> dict[str, Any]:
    result = CliRunner().invoke(app, ["info", str(path), "--json"], prog_name="touchline")
    assert result.exit_code == 0, result.stderr
    return cast("dict[str, Any]", json.loads(result.stdout))


def robots(recording: Recording) -> list[str]:
    assert recording.manifest.config is not None
    return [robot for side in Side for robot in recording.manifest.config.robots(side)]


@pytest.mark.parametrize("change", [delete, rewrite])
def test_a_recording_is_opened_and_verified_when_the_files_of_its_match_are_gone_or_edited(
    from_files: Path, change: Callable[[Path], None]
) -> None:
    change(from_files.parent)
    assert info(from_files)["seed"] == 7
    assert robots(open_recording(from_files)) == ["anna", "bert", "cleo"]
    verdict = verify(from_files)
    assert verdict.identical and verdict.ticks == 51


@pytest.mark.parametrize("change", [delete, rewrite])
def test_its_sights_are_simulated_again_without_them(from_files: Path, change: Callable[[Path], None]) -> None:
    change(from_files.parent)
    verdict = compare_brain(open_recording(from_files), "cleo", NUBOT)
    assert (verdict.compared, verdict.different) == (50, 0)
