"""The robots in JavaScript and C play: in one process, and as the robots of a match with real processes."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from recordings.reading.recording import open_recording
from schemas.config.match_config import load_match
from schemas.topics import APPLIED
from support.brisk import BRISK
from touchline.play.play_match import play_match

TOOLS = {"javascript": "node", "c_robot": "cc"}
ONE_AND_THE_OTHER = ["javascript", pytest.param("c_robot", marks=pytest.mark.long)]


@pytest.fixture(params=list(TOOLS))
def example(request: pytest.FixtureRequest, root: Path, tmp_path: Path) -> Path:
    """The match file of an example in a folder of its own, with the robot built."""
    name = request.param
    if shutil.which(TOOLS[name]) is None:
        assert os.environ.get("TOUCHLINE_EXAMPLES") != "needed", f"no {TOOLS[name]} where the examples have to run"
        pytest.skip(f"no {TOOLS[name]}; apt-get install nodejs gcc libc6-dev")
    folder = shutil.copytree(root / "examples" / "stdio_robot", tmp_path / "robots")
    if name == "c_robot":
        build = ["cc", "-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-O2", "-o", "robot", "robot.c", "-lm"]
        subprocess.run(build, cwd=folder, check=True)
    return folder / f"{name}.toml"


def test_it_takes_the_kick_off_carries_the_ball_and_shoots(
    example: Path, carry_and_shot: Callable[..., tuple[float, float]], capfd: pytest.CaptureFixture[str]
) -> None:
    carried, shot_from = carry_and_shot(load_match(example), 15.0, brain_folder=example.parent)
    assert carried > 3.0 and shot_from > 11.0 - 5.5
    assert "the program" not in capfd.readouterr().err


@pytest.mark.processes
@pytest.mark.parametrize("example", ONE_AND_THE_OTHER, indirect=True)
def test_its_match_with_real_processes_is_the_same_tick_for_tick(example: Path, tmp_path: Path) -> None:
    config = load_match(example, {"duration": 2.0, "patience.answer": 60.0, "rules": str(BRISK)})
    chains: dict[int, str] = {}
    play_match(
        config, watch=lambda tick: chains.update({tick.tick: tick.applied["chain"]}), brain_folder=example.parent
    )
    text = example.read_text().replace("duration = 60.0", f'duration = 2.0\npatience.answer = 60.0\nrules = "{BRISK}"')
    example.write_text(text)
    words = ["match", str(example), "--listen=tcp/127.0.0.1:0", "--record=match.mcap", "--json"]
    command = [sys.executable, "-m", "touchline", *words]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, timeout=100)
    applied = [one for _, one in open_recording(tmp_path / "match.mcap").decoded(APPLIED.key) if one.tick > 0]
    assert {one.tick: one.chain for one in applied} == chains
