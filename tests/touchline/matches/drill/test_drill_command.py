"""`touchline drill`, with a scene and brains of its own."""

from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from touchline.commands.cli.command_line import app

BRAINS = """
from touchline import Command, Drive


class Leaves:
    def __init__(self, briefing):
        pass

    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vy=2.0))


class Raises(Leaves):
    def act(self, sight):
        raise ValueError("no idea")
"""
SCENE = """
description = "A ball that rolls at the goal of cyan."
[ball]
x = -8.0
vx = -5.0
[[robots]]
name = "cyan1"
side = "cyan"
keeper = true
x = -10.6
y = 2.0
[[vary]]
body = "ball"
vy = 0.2
[drill]
seconds = 1.5
failure = ["goal:magenta"]
otherwise = "success"
"""


@pytest.fixture(scope="session")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("drill")
    (folder / "brains_of_a_drill.py").write_text(BRAINS)
    (folder / "at_goal.toml").write_text(SCENE)
    return folder / "at_goal.toml"


def drill(*words: str | Path) -> Result:
    return CliRunner().invoke(app, ["drill", *map(str, words)])


def test_a_keeper_that_leaves_lets_every_ball_in(scene: Path) -> None:
    result = drill(scene, "--brain", "brains_of_a_drill:Leaves", "--seeds", "1-3")
    assert result.exit_code == 0
    assert "0 of 3, 0 % (0 to 56 %)" in result.stdout
    assert "failure  goal:magenta  3, on average after " in result.stdout


def test_a_brain_that_raises_is_named_with_its_line(scene: Path) -> None:
    result = drill(scene, "--brain", "brains_of_a_drill:Raises", "--seeds", "1")
    assert result.exit_code == 1
    assert "seed 1: not played: cyan1, tick 0: ValueError: no idea (brains_of_a_drill.py, line 15)" in result.stderr


def test_a_scene_without_a_verdict_is_refused_with_those_that_have_one() -> None:
    result = drill("kick_off")
    assert result.exit_code == 2
    assert "kick_off has no [drill] with an end and a verdict; give one of corner, dribble_duel" in result.stderr
