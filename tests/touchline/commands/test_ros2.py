"""`touchline ros2` with nodes of two libraries that this project did not write, each in a process of its own."""

import shutil
import subprocess
import sys
from contextlib import ExitStack
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from recordings.reading.recording import open_recording
from schemas.topics import COMMAND
from support.ros_match import LIMIT_S, TEAM, graph_at, said_in, started, touchline
from touchline.verify.resimulate import verify

pytestmark = [
    pytest.mark.skipif(
        None in map(find_spec, ("xxhash", "zenoh_ros2_sdk", "pyzeros")),
        reason="needs xxhash and zenoh_ros2_sdk and pyzeros",
    ),
    pytest.mark.processes,
    pytest.mark.slow,
]

ROBOTS = [f"cyan{number}" for number in range(1, 6)]
MATCH = """
name = "{name}"
seed = 5
pace = "{pace}"
duration = 2.0
rules = "friendly"
patience.answer = 60

[teams.cyan]
remote = true

[teams.magenta]
brain = "simple"
robots = ["magenta1", "magenta2"]
"""


def play(folder: Path, name: str, pace: str, library: str, *options: str) -> tuple[Path, str]:
    """The recording of a match whose cyan robots nodes drive, and what the bridge has said."""
    (folder / "match.toml").write_text(MATCH.format(name=name, pace=pace))
    with ExitStack() as stack:
        log = folder / "match.log"
        with log.open("w") as file:
            match = subprocess.Popen(
                touchline("match", "match.toml", "--listen", "tcp/127.0.0.1:0"),
                cwd=folder,
                stdout=file,
                stderr=subprocess.STDOUT,
            )
        stack.callback(match.wait)
        stack.callback(match.terminate)
        said_in(log, "(waiting for cyan)")
        words = touchline("ros2", "--match", name, "--side", "cyan", "--listen", "tcp/127.0.0.1:0", "--patience", "60")
        said = stack.enter_context(started(words, folder, "ros2"))
        nodes = [sys.executable, "-W", "ignore", str(TEAM), *options, library, graph_at(said), *ROBOTS]
        team = stack.enter_context(started(nodes, folder, "team"))
        status = match.wait(LIMIT_S)
        assert status == 0, log.read_text() + said.read_text() + team.read_text()
    (recording,) = folder.glob("runs/*/match.mcap")
    return recording, said.read_text()


def answered(recording: Path) -> dict[str, list[Any]]:
    """Robot → its commands."""
    opened = open_recording(recording)
    return {robot: [one for _, one in opened.decoded(COMMAND.fill(robot=robot))] for robot in ROBOTS}


@pytest.mark.parametrize(("library", "options"), [("pyzeros", ()), ("sdk", ("--twist",))])
def test_a_team_of_nodes_of_one_foreign_process_plays_in_lockstep_and_its_recording_verifies(
    tmp_path: Path, library: str, options: tuple[str, ...]
) -> None:
    if library == "pyzeros" and shutil.which("cc") is None:
        pytest.skip("pyzeros compiles its types")
    recording, said = play(tmp_path, f"lock_{library}{len(options)}", "lockstep", library, *options)
    for commands in answered(recording).values():
        ticks = list(dict.fromkeys(one.answers_tick for one in commands))  # a sight that comes again is answered again
        assert ticks == list(range(len(ticks)))
        assert len(ticks) > 90
        driven = [one for one in commands if (one.drive.vx, one.drive.omega) == (1.0, 0.5)]
        assert len(driven) >= 0.99 * len(commands)
    assert "unanswered" not in said
    assert verify(recording).identical


@pytest.mark.long
def test_in_real_time_the_nodes_drive_at_their_own_pace(tmp_path: Path) -> None:
    recording, _ = play(tmp_path, "real_sdk", "realtime", "sdk")
    for commands in answered(recording).values():
        driven = [one for one in commands if (one.drive.vx, one.drive.omega) == (1.0, 0.5)]
        assert len(driven) > 50
