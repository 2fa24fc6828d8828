"""`touchline task`: the tasks that ship, a user's own, and what a brain makes of them."""

import json
from pathlib import Path
from typing import Annotated

import pytest
import typer
from typer.testing import CliRunner, Result

from recordings.reading.recording import open_recording
from touchline.commands.cli.command_line import app
from touchline.matches.task.task import shipped_tasks
from touchline.verify.resimulate import verify

TASK = """
name = "get_there"
game = "free"
duration = 2.0
[task]
score = "own_task:way"
unit = "m"
[teams.cyan]
brain = "own_task:Ahead"
[scene]
description = "A robot drives as far as it can in two seconds; the score is how far."
robots = [{ name = "one", side = "cyan", x = 0.0, y = 0.0 }]
vary = [{ body = "one", heading = 0.6 }]
"""
CODE = """
import time
from touchline import Command, Drive, Score

def way(now):
    at = now.robots["one"]
    turned = ["turned away"] * (at.heading > 0.3 and now.tick == 5)
    return Score(at.x, over=now.memory == "far", memory="far" if at.x > 9 else None, events=turned)

class Ahead:
    def __init__(self, briefing):
        pass

    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0))

class Raises(Ahead):
    def act(self, sight):
        raise ValueError("no idea")

class ReadsAClock(Ahead):
    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=time.time() % 1.0))
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("task")
    (folder / "get_there.toml").write_text(TASK)
    (folder / "own_task.py").write_text(CODE)
    (folder / "plain.toml").write_text("seed = 2\n")
    return folder


@pytest.fixture
def own(folder: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(folder)
    return "get_there.toml"


def task(*words: str | Path) -> Result:
    return CliRunner().invoke(app, ["task", *map(str, words)])


def test_the_list_has_every_task_with_what_its_score_is() -> None:
    lines = task("list").stdout.splitlines()
    assert [line.split()[0] for line in lines] == shipped_tasks()
    assert all(line.endswith(".") for line in lines)
    assert [line.split()[2:4] for line in lines if line.startswith("goalkeeper ")] == [["1", "robot"]]
    listed = json.loads(task("list", "--json").stdout)["tasks"]
    assert listed[0].keys() == {"task", "game", "robots", "unit", "seconds", "description"}


def test_a_score_has_its_unit_and_interval_and_equal_seeds_have_equal_ones(own: str) -> None:
    result = task("run", own, "--episodes", "6", "--json")
    assert result.exit_code == 0, result.output
    played = json.loads(result.stdout)["result"]
    assert [one["seed"] for one in played["episodes"]] == [1, 2, 3, 4, 5, 6]
    assert played["score"]["low"] < played["score"]["value"] < played["score"]["high"] < 2.0
    again = json.loads(task("run", own, "--seeds", "1-6", "--json").stdout)["result"]
    assert again == played
    assert "get_there: " in (line := task("run", own, "--episodes", "2").stdout) and " m (" in line


@pytest.mark.parametrize(("bound", "status"), [("0.5", 0), ("5", 1)])
def test_a_score_below_the_bound_is_a_status_of_1(own: str, bound: str, status: int) -> None:
    result = task("run", own, "--episodes", "3", "--at-least", bound)
    assert result.exit_code == status
    assert ("less than --at-least 5" in result.stderr) == (status == 1)


def test_a_bound_that_is_no_number_is_refused_before_anything_is_played(own: str) -> None:
    result = task("run", own, "--at-least", "nan")
    assert (result.exit_code, result.output) == (2, "touchline: --at-least is nan; give a number\n")


def test_failures_leave_recordings_that_verify_and_the_events_that_they_share(own: str, tmp_path: Path) -> None:
    result = task("run", own, "--episodes", "8", "--failures", "3", "--out", tmp_path / "kept", "--json")
    assert result.exit_code == 0, result.output
    content = json.loads(result.stdout)
    episodes = sorted(content["result"]["episodes"], key=lambda one: one["score"])
    kept = content["failures"]["kept"]
    assert [one["worth"] for one in kept] == [one["score"] for one in episodes[:3]]
    recording = open_recording(Path(kept[0]["recording"]))
    assert recording.manifest.config.seed == episodes[0]["seed"]
    checked = verify(Path(kept[0]["recording"]), referee=True)
    assert checked.identical and checked.referee
    (shared,) = content["failures"]["shared"]
    assert shared["event"] == "turned away" and shared["failures"] > 0
    assert len(list((tmp_path / "kept").glob("*.mcap"))) == 3
    again = task("run", own, "--failures", "3", "--out", tmp_path / "kept")
    assert again.exit_code == 2 and "kept: has recordings; give another folder with --out" in again.output


def test_the_worst_episode_is_shown_and_the_status_is_that_of_the_task(
    own: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown: dict[str, object] = {}

    def replay(files: list[Path], rate: float = 1.0, web: Annotated[bool, typer.Option("--web")] = False) -> None:
        shown.update(files=files, rate=rate, web=web)

    monkeypatch.setattr("touchline.commands.replay.replay", replay)
    result = task("run", own, "--episodes", "2", "--at-least", "5", "--failures", "1", "--show")
    assert (result.exit_code, type(result.exception)) == (1, SystemExit)
    assert shown == {"files": [*Path().glob("runs/get_there-failures-*/*.mcap")], "rate": 1.0, "web": True}


def test_only_episodes_below_the_bound_are_failures(own: str, tmp_path: Path) -> None:
    result = task("run", own, "--episodes", "2", "--failures", "2", "--below", "0.1", "--out", tmp_path / "kept")
    assert "no failures" in result.stdout
    assert not (tmp_path / "kept").exists()


def test_the_score_is_printed_also_if_a_failure_was_another_episode_when_it_was_played_again(
    own: str, tmp_path: Path
) -> None:
    words = ("--brain", "own_task:ReadsAClock", "--episodes", "1", "--failures", "1", "--out", tmp_path / "kept")
    result = task("run", own, *words)
    assert result.exit_code == 1, result.output
    score, *_, said = result.stdout.splitlines()
    assert score.startswith("get_there: ") and " in 1 episode;" in score
    assert said.startswith("get_there, seed 1 was another match")


def test_a_brain_that_raises_is_named_and_its_episode_has_no_score(own: str) -> None:
    result = task("run", own, "--brain", "own_task:Raises", "--episodes", "1")
    assert result.exit_code == 1
    assert "seed 1: not played: one, tick 0: ValueError: no idea (own_task.py, line 19)" in result.stderr


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ("keepaway_3vv",),
            'no task is named "keepaway_3vv"; give a name or a .toml file; did you mean "keepaway_3v2"',
        ),
        (("get_there.toml", "--episodes", "2", "--seeds", "1-2"), "--episodes 2 and --seeds 1-2 are both given"),
        (("plain.toml",), "plain.toml is a match without a score; write [task]"),
        (("missing.toml",), "missing.toml"),
    ],
)
@pytest.mark.usefixtures("own")
def test_a_wrong_word_is_one_line_with_its_remedy(words: tuple[str, ...], said: str) -> None:
    result = task("run", *words)
    assert result.exit_code == 2
    assert said in result.stderr and len(result.stderr.splitlines()) == 1
