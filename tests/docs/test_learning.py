"""docs/learning.md: its commands lead from nothing to a policy that plays a match, and its pieces of Python run."""

import importlib
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
from support.imports import forgotten_imports
from touchline.commands.cli.command_line import app
from touchline.play.play_match import play_match
from touchline.policy.groups import OF_MATCH
from touchline.policy.interface import GROUPS
from touchline.verify.resimulate import verify

Fenced = Callable[[str, str], list[str]]


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "learning.md").read_text("utf-8")


@pytest.mark.slow
def test_its_commands_train_policies_that_do_the_task(
    page: str, fenced: Fenced, root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("stable_baselines3")
    ((_, train, run, _),) = [[shlex.split(line) for line in piece.splitlines()] for piece in fenced(page, "sh")]
    monkeypatch.chdir(tmp_path)
    said = played(root, [*train[1:], "--minutes", "0.1"])
    assert re.search(r"^run 1: [\d.]+$", said, re.MULTILINE), said
    result = CliRunner().invoke(app, [*run[1:-1], "2", "--jobs", "1"])
    assert result.exit_code == 0 and re.match(r"coverage: [\d.]+ of the floor", result.stdout), result.output


@pytest.mark.slow
def test_its_commands_score_numbers_that_cma_es_has_tuned(
    page: str, fenced: Fenced, root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    *_, tune = [shlex.split(line) for piece in fenced(page, "sh") for line in piece.splitlines()]
    monkeypatch.chdir(tmp_path)
    said = played(root, [*tune[1:], "--minutes", "0"])
    found = re.search(
        r"^baseline: (.*)\nrun 1, pressed 2.2, long 3.0, corner 4.0, arriving 3.5: (.*)$", said, re.MULTILINE
    )
    assert found is not None and found[1] == found[2], said
    assert re.search(r"^more than the baseline, over 1 runs: 0$", said, re.MULTILINE), said
    assert (tmp_path / said.splitlines()[-1]).read_bytes().startswith(b"\x89PNG")


def played(root: Path, command: list[str]) -> str:
    """What an example prints that trains once, and scores with one episode."""
    small = ["--runs", "1", "--episodes", "1", "--jobs", "1"]
    return subprocess.run(
        [sys.executable, root / command[0], *command[1:], *small], check=True, stdout=-1, text=True
    ).stdout


@pytest.mark.slow
def test_cma_es_finds_better_numbers(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with forgotten_imports(root / "examples" / "learn"):
        sys.path.append(str(root / "examples" / "learn"))
        example = importlib.import_module("cmaes_keepaway")

    def scores(_task: str, seeds: range, _brain: None, overrides: dict[str, float]) -> list[float]:
        return [0.01 * (seed % 3) - abs(overrides["teams.cyan.parameters.long"] - 4.0) for seed in seeds]

    monkeypatch.setattr(example, "scores", scores)
    found, curve = example.tune(1, 0.02)
    assert found["teams.cyan.parameters.long"] == pytest.approx(4.0, abs=0.4)
    assert curve[-1][1] > curve[0][1]


@pytest.mark.slow
@pytest.mark.processes
def test_a_policy_plays_in_processes_as_in_one(
    page: str, fenced: Fenced, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (match_file,), (make, *_) = fenced(page, "toml"), fenced(page, "python")
    monkeypatch.chdir(tmp_path)
    exec(make, {})
    Path("keeper.toml").write_text(match_file)
    listen = ["--listen", "tcp/127.0.0.1:0", "--duration", "1", "--record", "keeper.mcap"]
    result = CliRunner().invoke(app, ["match", "keeper.toml", *listen])
    assert result.exit_code == 0, result.output
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
    assert len(pieces) == 3
    assert "ball.x m 5.0" in capsys.readouterr().out
    assert verify(tmp_path / "seven.mcap", referee=True).identical


def test_its_table_names_all_groups_of_an_observation(page: str) -> None:
    _, _, table = page.partition("## Observations")
    assert tuple(re.findall(r"^\| `(\w+)` \|", table.partition("## Actions")[0], re.MULTILINE)) == GROUPS
    assert {*OF_MATCH, "sensors"} == {*GROUPS}
