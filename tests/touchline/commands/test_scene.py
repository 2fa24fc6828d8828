"""`touchline scene` and `touchline scene list`, against a simulation of the same process."""

import json
import math
from collections.abc import Iterator
from pathlib import Path

import pytest
from pytest import approx
from typer.testing import CliRunner, Result

from schemas.config.match_config import load_match
from schemas.config.scene import shipped_scenes
from schemas.side import Side
from schemas.topics import SCENE
from sim_host.match.simulation import Simulation
from support.terminal import Terminal
from touchline.commands.cli.command_line import app
from touchline.play.play_match import InProcessMatch


@pytest.fixture
def simulation(terminal: Terminal) -> Iterator[Simulation]:
    """Answers as a host does."""
    simulation = Simulation(load_match(None))
    terminal.answers({SCENE: simulation.handle_scene})
    yield simulation
    simulation.close()


def touchline(*words: str) -> Result:
    return CliRunner().invoke(app, list(words), prog_name="touchline")


def accepted(*words: str) -> str:
    result = touchline("scene", *words)
    assert result.exit_code == 0, result.stderr
    return result.stdout


def test_bodies_are_set_down_added_and_removed_by_hand(simulation: Simulation) -> None:
    assert accepted("place", "ball", "-3.5", "-2", "--vx", "4") == "place accepted, episode 1\n"
    accepted("remove", "magenta5")
    accepted("add", "magenta6", "magenta", "5", "-5", "--type", "slow", "--still")
    accepted("add-obstacle", "wall", "-3", "5", "--size", "0.2", "2", "0.5")
    accepted("add-obstacle", "pole", "3", "-5", "--radius", "0.1", "--height", "1")
    tick = simulation.step({})
    assert (tick.world["ball"]["x"], tick.world["ball"]["y"]) == approx((-3.42, -2.0), abs=0.01)
    assert "magenta5" not in tick.world["robots"] and tick.world["robots"]["magenta6"]["y"] == approx(-5.0)
    assert list(tick.world["obstacles"]) == ["wall", "pole"]


def test_scenes_are_loaded_by_name_and_by_file_and_begun_anew(simulation: Simulation, tmp_path: Path) -> None:
    assert accepted("load", "penalty") == "load accepted, episode 2\n"
    file = tmp_path / "mine.toml"
    file.write_text('description = "Mine."\n[[robots]]\nname = "anna"\nside = "cyan"\nx = 1.0\ny = 2.0\n')
    assert accepted("load", str(file)) == "load accepted, episode 3\n"
    assert list(simulation.step({}).world["robots"]) == ["anna"]
    assert accepted("reset", "--to-start") == "reset accepted, episode 4\n"
    assert len(simulation.step({}).world["robots"]) == 10


def test_the_scenes_are_listed_with_a_sentence_each_and_shown() -> None:
    lines = touchline("scene", "list").stdout.splitlines()
    assert [line.split()[0] for line in lines] == shipped_scenes()
    assert set(json.loads(touchline("scene", "list", "--json").stdout)) == set(shipped_scenes())
    shown = touchline("scene", "list", "paper_static").stdout
    assert shown.count("stands still") == 3
    assert json.loads(touchline("scene", "list", "penalty", "--json").stdout)["game"]["side"] == "cyan"


@pytest.mark.slow
@pytest.mark.parametrize("name", shipped_scenes())
def test_the_shipped_teams_play_every_scene(name: str) -> None:
    """A robot of each side that has an agent moves within two seconds."""
    config = load_match(None, {"scene": name})
    table = InProcessMatch(config, chained=False)
    start, waiting = table.simulation.now.world["robots"], [side for side in Side if config.robots(side)]
    while waiting and table.simulation.now.time < 2.0:
        robots = table.step().world["robots"]
        ways = {name: math.dist(*[(one["x"], one["y"]) for one in (robots[name], start[name])]) for name in robots}
        waiting = [side for side in waiting if sum(ways[robot] for robot in config.robots(side)) < 0.05]
    table.simulation.close()
    assert waiting == []


def test_the_scene_selects_profile_and_rules_unless_the_match_does() -> None:
    assert (load_match(None, {"scene": "paper_static"}).profile, load_match(None).profile) == ("paper", "msl")
    assert load_match(None, {"scene": "paper_static", "profile": "msl"}).profile == "msl"
