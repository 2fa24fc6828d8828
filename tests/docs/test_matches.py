"""The match files that ship, and the first brain in its match."""

import re
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest

from schemas.config.match_config import MatchConfig, load_match
from schemas.config.scene import Scene
from schemas.config.soccer.rule_book import load_rule_book
from schemas.side import Side
from schemas.soccer.game import EventKind
from touchline.launch.check_brains import check_teams
from touchline.play.play_match import play_match

HERE = Path(__file__).parents[2]
CUP = HERE / "matches" / "cup.toml"
STUDY = HERE / "examples" / "coverage" / "study.toml"
HARDWARE = HERE / "examples" / "two_bodies" / "robot.toml"
FILES = sorted({*HERE.glob("matches/*.toml"), *HERE.glob("examples/**/*.toml")} - {CUP, STUDY, HARDWARE})


@pytest.fixture(autouse=True)
def at_home(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Brains are looked for in the current directory."""
    monkeypatch.chdir(root)
    monkeypatch.syspath_prepend(root)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_every_match_file_loads_with_all_it_names(file: Path) -> None:
    config = load_match(file)
    config.load_profile()
    load_rule_book(config.rules)
    if config.teams.cyan.program is None:
        check_teams(config, file.parent)
    assert config.name == file.stem


def test_the_friendly_is_the_match_that_is_played_without_a_file(root: Path) -> None:
    assert load_match(root / "matches" / "friendly.toml") == MatchConfig()


def test_the_friendly_shows_every_word_of_a_match_file(root: Path) -> None:
    text = (root / "matches" / "friendly.toml").read_text("utf-8")
    shown = re.findall(r"^(?:# )?(\w+) = |^\[(?:teams\.)?(\w+)\]", text, re.MULTILINE)
    obstacles = re.findall(r"^# obstacles = (.*)", text, re.MULTILINE)
    words = {key or table for key, table in shown} | set(re.findall(r"(\w+) = ", "".join(obstacles)))
    schema = MatchConfig.model_json_schema()
    asked = set(schema["properties"]) - {"teams", "profile_tables", "rule_book_tables"}
    asked -= {"task"}  # docs/tasks.md has its words
    of_scenes = {"Scene", "TaskConfig", "Zone", *Scene.model_json_schema()["$defs"]} - {"ObstacleConfig"}
    for name, part in schema["$defs"].items():
        if name not in of_scenes:
            asked |= set(part.get("properties", {}))
    assert words == asked


def test_every_line_of_the_friendly_that_is_left_out_may_be_put_in(root: Path, tmp_path: Path) -> None:
    lines = (root / "matches" / "friendly.toml").read_text("utf-8").splitlines()
    optional = [number for number, line in enumerate(lines) if re.match(r"# \w+ = ", line)]
    assert len(optional) >= 6
    for number in optional:
        put_in = lines[number].removeprefix("# ")
        kept = [line for line in lines if not (put_in.startswith(("command", "stdio")) and line.startswith("brain"))]
        kept[kept.index(lines[number])] = put_in
        file = tmp_path / "friendly.toml"
        file.write_text("\n".join(kept))
        load_match(file)
        assert tomllib.loads(file.read_text()) != tomllib.loads("\n".join(lines)), put_in


def test_the_papers_match_is_three_a_side_on_its_own_pitch(root: Path) -> None:
    config = load_match(root / "matches" / "paper.toml")
    assert [len(config.robots(side)) for side in Side] == [3, 3]
    assert config.load_profile().field.length == 18.0
    played = play_match(config, until=12.0)
    assert [event.kind for event in played.events][:3] == [EventKind.RESTART, EventKind.START, EventKind.IN_PLAY]


def test_the_first_brain_gets_the_ball_carries_it_and_shoots(
    root: Path, carry_and_shot: Callable[..., tuple[float, float]]
) -> None:
    config = load_match(root / "examples" / "first_brain.toml")
    carried, shot_from = carry_and_shot(config, 20.0)
    assert carried > 3.0 and shot_from > config.load_profile().field.goal_line - 5.5
