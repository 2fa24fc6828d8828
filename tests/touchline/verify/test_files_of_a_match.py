"""A recording holds the scene and the profile of its match: it needs none of the files that they were read from."""

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, cast

import pytest
from typer.testing import CliRunner

from recordings.reading.recording import Recording, open_recording
from schemas.config.match_config import load_match
from schemas.config.scene import load_scene
from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.command_line import app
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


@pytest.fixture
def named(from_files: Path, edited: Callable[..., Path]) -> Callable[..., Path]:
    """Copies that recording as one whose config names its scene and its profile, and does not hold them."""

    def copy(scene: str, types: Mapping[str, str] = MappingProxyType({})) -> Path:
        def name_them(record: str, fields: dict[str, str]) -> dict[str, str]:
            if record != "manifest":
                return fields
            config = json.loads(fields["config"])
            del config["profile_tables"]
            config["teams"]["magenta"]["types"] = dict(types)
            return fields | {"config": json.dumps(config | {"scene": scene})}

        def name_in_file(name: str, content: bytes) -> bytes:
            return (
                name_them("manifest", {"config": content.decode()})["config"].encode()
                if name == "match.json"
                else content
            )

        return edited(from_files, "", lambda fields: fields, name_them, attachment=name_in_file)

    return copy


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


def test_where_a_config_names_a_shipped_scene_it_is_that_scene(named: Callable[..., Path]) -> None:
    recording = open_recording(named("penalty"))
    assert recording.manifest.missing_scene is None
    assert robots(recording) == [robot.name for robot in load_scene("penalty").robots if robot.agent]


def test_where_a_config_names_a_file_that_is_there_it_is_read(named: Callable[..., Path], tmp_path: Path) -> None:
    recording = open_recording(named(str(tmp_path / "mine.toml")))
    assert robots(recording) == ["anna", "bert", "cleo"]
    (tmp_path / "slow.toml").unlink()
    assert compare_brain(recording, "cleo", NUBOT).compared == 50


@pytest.mark.parametrize("types", [{}, {"cleo": "keeper"}])
def test_where_a_config_names_a_missing_file_the_setup_names_the_robots(
    named: Callable[..., Path], tmp_path: Path, types: dict[str, str]
) -> None:
    """Only simulating the sights needs the scene itself."""
    path = named(str(tmp_path / "mine.toml"), types)
    delete(tmp_path)
    recording = open_recording(path)
    assert recording.manifest.missing_scene == str(tmp_path / "mine.toml")
    assert recording.manifest.setup is not None
    assert recording.manifest.setup.teams[Side.CYAN].robots == ["anna", "bert"]
    assert info(path)["seed"] == 7
    assert verify(path, referee=False).identical
    with pytest.raises(TouchlineError, match=r"its scene .*mine\.toml cannot be read; restore"):
        compare_brain(recording, "cleo", NUBOT)


@pytest.mark.parametrize("types", [{}, {"cleo": "keeper"}])
def test_where_a_config_names_a_file_that_was_edited_the_recording_is_verified_all_the_same(
    named: Callable[..., Path], tmp_path: Path, types: dict[str, str]
) -> None:
    path = named(str(tmp_path / "mine.toml"), types)
    rewrite(tmp_path)
    assert info(path)["seed"] == 7
    assert verify(path, referee=False).identical


def test_sights_that_are_simulated_from_an_edited_scene_are_not_compared(
    named: Callable[..., Path], tmp_path: Path
) -> None:
    path = named(str(tmp_path / "mine.toml"))
    rewrite(tmp_path)
    verdict = compare_brain(open_recording(path), "cleo", NUBOT)
    assert (verdict.compared, verdict.until) == (0, "at tick 0 the world differs from the recorded one")
