"""The protocol page is enough: a robot written from it alone plays with real processes over real Zenoh."""

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from recordings.reading.recording import open_recording
from schemas.topics import COMMAND, HEALTH
from support.brisk import BRISK


@pytest.mark.processes
def test_a_robot_of_zenoh_and_json_alone_answers_every_sight(root: Path, tmp_path: Path) -> None:
    team = tomllib.loads((root / "examples" / "plain_robot.toml").read_text("utf-8"))["teams"]["cyan"]
    program = [sys.executable, str(root / team["command"][-1])]
    teams = f"[teams.cyan]\nsize = 1\ncommand = {program}\n[teams.magenta]\nsize = 1\n"
    rules = f'rules = "{BRISK}"\npatience.answer = 60\n'  # also on a machine that is busy otherwise
    (tmp_path / "plain.toml").write_text(rules + teams)
    words = ["match", "plain.toml", "--duration=2", "--listen=tcp/127.0.0.1:0", "--record=plain.mcap", "--json"]
    subprocess.run(
        [sys.executable, "-m", "touchline", *words], cwd=tmp_path, check=True, capture_output=True, timeout=100
    )
    recording = open_recording(tmp_path / "plain.mcap")
    assert recording.result is not None
    key = COMMAND.fill(robot="cyan1")
    count = recording.result.keys[key]
    health = [message for _, message in recording.decoded(HEALTH.key)][-1].robots["cyan1"]
    last = recording.result.tick  # no process waits for the answer to the last sight
    answered = sorted({message.answers_tick for _, message in recording.decoded(key)})  # one sent twice has two answers
    assert answered in (list(range(last)), list(range(last + 1)))
    assert (count.lost, count.unstamped, health.invalid, health.missed) == (0, 0, 0, 0)


def test_the_plain_robot_imports_nothing_of_this_project(root: Path) -> None:
    source = (root / "examples" / "plain_robot.py").read_text("utf-8")
    imported = {line.split()[1].split(".")[0] for line in source.splitlines() if line.startswith(("import ", "from "))}
    assert imported - set(sys.stdlib_module_names) == {"zenoh"}
