"""docs/learning.md: its commands lead from nothing to a policy that plays a match, and its pieces of Python run."""

import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner

from recordings.reading.recording import open_recording
from schemas.config.match_config import load_match
from touchline.commands.cli.command_line import app
from touchline.learn import Network
from touchline.play.play_match import play_match
from touchline.policy.groups import OF_MATCH
from touchline.policy.interface import GROUPS
from touchline.verify.resimulate import verify

Fenced = Callable[[str, str], list[str]]


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "learning.md").read_text("utf-8")


@pytest.mark.slow
@pytest.mark.processes
def test_its_commands_train_a_policy_that_does_the_task_and_plays_a_match(
    page: str, fenced: Fenced, root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (commands,), (match_file,) = fenced(page, "sh"), fenced(page, "toml")
    _, train, run = [shlex.split(line) for line in commands.splitlines()]
    monkeypatch.chdir(tmp_path)
    small = ["--generations", "1", "--episodes", "1", "--processes", "1"]
    # in a process of its own: it forks, and a fork of one with the threads of Zenoh may hang
    subprocess.run([sys.executable, root / train[1], *train[2:], *small], check=True)
    assert Network.load(Path("keeper.npz")).actions == 6
    result = CliRunner().invoke(app, [*run[1:-1], "2", "--jobs", "1"])
    assert result.exit_code == 0 and re.match(r"keepaway_3v2: [\d.]+ s \(", result.stdout), result.output
    Path("keeper.toml").write_text(match_file)
    listen = ["--listen", "tcp/127.0.0.1:0", "--duration", "1", "--record", "keeper.mcap"]
    played = CliRunner().invoke(app, ["match", "keeper.toml", *listen])
    assert played.exit_code == 0, played.output
    assert verify(Path("keeper.mcap")).identical
    alone = play_match(load_match(Path("keeper.toml"), {"duration": 1.0}))
    *_, (_, last) = open_recording(Path("keeper.mcap")).decoded("host/applied")
    assert (last.tick, last.chain) == (alone.ticks, alone.chain)  # processes over Zenoh, and one process


@pytest.mark.slow
def test_its_pieces_of_python_run(
    page: str, fenced: Fenced, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    pieces = fenced(page, "python")
    for piece in pieces:
        exec(piece, {})
    assert len(pieces) == 2
    assert "ball.x m 5.0" in capsys.readouterr().out
    assert verify(tmp_path / "seven.mcap", referee=True).identical


def test_its_table_names_all_groups_of_an_observation(page: str) -> None:
    _, _, table = page.partition("## Observations")
    assert tuple(re.findall(r"^\| `(\w+)` \|", table.partition("## Actions")[0], re.MULTILINE)) == GROUPS
    assert {*OF_MATCH, "sensors"} == {*GROUPS}
