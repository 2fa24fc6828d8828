"""A cup that is played: resumed after it was killed, equal for any number of processes, and verified."""

import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from multiprocessing import active_children
from pathlib import Path

import pytest
from typer.testing import CliRunner

from schemas.errors import TouchlineError
from touchline.command_line import app
from touchline.tournament.cup_config import load_cup
from touchline.tournament.playing.outcome import FailureKind, Outcome
from touchline.tournament.playing.run_cup import CupRun
from touchline.tournament.playing.store import CupStore
from touchline.tournament.playing.verify_cup import verify_cup
from touchline.tournament.playing.worker import Workers
from touchline.tournament.report import report_of

CUP = """
name = "mini"
size = 1
[match]
duration = 2.0
scene = "one_against_keeper"
[[teams]]
name = "One"
brain = "reference"
[[teams]]
name = "Two"
brain = "simple"
[[teams]]
name = "Three"
brain = "random"
"""
KILLS = 4


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a cup that was played by one process."""
    folder = tmp_path_factory.mktemp("cup")
    file = folder / "mini.toml"
    file.write_text(CUP)
    with closing(CupRun(load_cup(file), folder, folder / "out", resume=False)) as run:
        state = run.play(1, lambda *_: None)
    assert state.is_complete
    return folder


def report_in(folder: Path) -> object:
    """The report on a stored cup."""
    cup = load_cup(folder / "mini.toml")
    with closing(CupRun(cup, folder, folder / "out", resume=True)) as run:
        return report_of(run.state)


def test_two_processes_give_the_same_results_and_chains_as_one(undisturbed: Path, tmp_path: Path) -> None:
    file = tmp_path / "mini.toml"
    file.write_text(CUP)
    with closing(CupRun(load_cup(file), tmp_path, tmp_path / "out", resume=False)) as run:
        run.play(2, lambda *_: None)
    assert report_in(tmp_path) == report_in(undisturbed)


def test_a_cup_that_is_killed_again_and_again_and_resumed_has_the_table_of_the_undisturbed_one(
    undisturbed: Path, tmp_path: Path
) -> None:
    (tmp_path / "mini.toml").write_text(CUP)
    command = [sys.executable, "-m", "touchline", "tournament", str(tmp_path / "mini.toml")]
    command += ["--out", str(tmp_path / "out"), "--resume", "--jobs", "2"]
    drawn = random.Random(5)
    stored: dict[str, str] = {}
    for _ in range(KILLS):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        time.sleep(drawn.uniform(0.5, 3.0))
        process.kill()
        process.communicate()
        if (tmp_path / "out" / "cup.sqlite").exists():
            with closing(CupStore(tmp_path / "out", writes=False)) as store:
                now = {name: outcome.to_json() for name, (_, outcome) in store.outcomes.items()}
            assert stored.items() <= now.items(), "no finished match is lost or played again"
            stored = now
    assert subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0
    assert report_in(tmp_path) == report_in(undisturbed)


def test_a_worker_that_dies_costs_its_match_only_and_that_is_played_when_the_cup_is_resumed(
    undisturbed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "mini.toml"
    file.write_text(CUP)
    start, killed = Workers.start, []

    def start_and_kill(workers: Workers, planned: object) -> None:
        start(workers, planned)  # type: ignore[arg-type]
        if not killed:
            (pid,) = (process.pid for process in active_children())
            killed.append(pid)
            os.kill(pid or 0, signal.SIGKILL)

    monkeypatch.setattr(Workers, "start", start_and_kill)
    with closing(CupRun(load_cup(file), tmp_path, tmp_path / "out", resume=False)) as run:
        state = run.play(1, lambda *_: None)
    assert [one.slot.name for one in state.failed] == ["league 1"]
    assert state.failed[0].ended is not None and "SIGKILL" in (state.failed[0].ended.reason or "")
    with closing(CupRun(load_cup(file), tmp_path, tmp_path / "out", resume=True)) as run:
        assert run.play(1, lambda *_: None).is_complete
    assert report_in(tmp_path) == report_in(undisturbed)


def test_pages_and_recordings_of_all_matches_are_in_the_folder(undisturbed: Path) -> None:
    out = undisturbed / "out"
    names = {"league_1", "league_2", "league_3"}
    assert {file.stem for file in (out / "recordings").iterdir()} == names
    assert {file.stem for file in (out / "matches").iterdir()} == names
    page = (out / "matches" / "league_3.html").read_text("utf-8")
    assert 'id="pitch"' in page and '<nav><a href="../index.html">' in page
    index = (out / "index.html").read_text("utf-8")
    assert "Winner" in index and "refresh" not in index


def test_an_untouched_cup_is_verified(undisturbed: Path) -> None:
    assert verify_cup(undisturbed / "out", 1) == ([], 3)
    assert verify_cup(undisturbed / "out", 1, sample=1) == ([], 1)


def test_verification_names_the_match_whose_stored_result_was_changed(undisturbed: Path, tmp_path: Path) -> None:
    shutil.copytree(undisturbed / "out", tmp_path / "out")
    with sqlite3.connect(tmp_path / "out" / "cup.sqlite") as database:
        row = database.execute("SELECT outcome FROM outcomes WHERE match = 'league 3'").fetchone()
        changed = json.loads(row[0]) | {"goals": [7, 0]}
        database.execute("UPDATE outcomes SET outcome = ? WHERE match = 'league 3'", (json.dumps(changed),))
    database.close()
    (fault,) = verify_cup(tmp_path / "out", 1, sample=1)[0]
    assert fault.startswith("league 3: its result is not that of its recording: goals is (7, 0)")


def test_verification_names_the_match_whose_recording_is_another_ones(undisturbed: Path, tmp_path: Path) -> None:
    shutil.copytree(undisturbed / "out", tmp_path / "out")
    recordings = tmp_path / "out" / "recordings"
    shutil.copy(recordings / "league_1.mcap", recordings / "league_2.mcap")
    faults, _ = verify_cup(tmp_path / "out", 1, sample=1)
    assert faults == ["league 2: its recording is of another match than the cup plans"]
    (recordings / "league_3.mcap").unlink()
    assert any(fault.startswith("league 3: ") for fault in verify_cup(tmp_path / "out", 1, sample=1)[0])


def test_a_folder_with_a_cup_is_not_played_again_without_resume(undisturbed: Path) -> None:
    cup = load_cup(undisturbed / "mini.toml")
    with pytest.raises(TouchlineError, match="has a cup already; add --resume"):
        CupRun(cup, undisturbed, undisturbed / "out", resume=False)
    other = cup.model_copy(update={"seed": 9})
    with pytest.raises(TouchlineError, match="its cup is another one than that of the file"):
        CupRun(other, undisturbed, undisturbed / "out", resume=True)


def test_a_team_whose_files_have_changed_stops_the_cup_from_being_resumed(tmp_path: Path) -> None:
    (tmp_path / "own_team.py").write_text("class Own: ...")
    file = tmp_path / "mini.toml"
    file.write_text(CUP.replace('"random"', '"own_team:Own"'))
    CupRun(load_cup(file), tmp_path, tmp_path / "out", resume=False).close()
    CupRun(load_cup(file), tmp_path, tmp_path / "out", resume=True).close()
    (tmp_path / "own_team.py").write_text("class Own: pass")
    with pytest.raises(TouchlineError, match='files of team "Three" have changed since the cup began'):
        CupRun(load_cup(file), tmp_path, tmp_path / "out", resume=True)


def test_two_processes_cannot_play_the_same_cup(undisturbed: Path) -> None:
    cup = load_cup(undisturbed / "mini.toml")
    with (
        closing(CupRun(cup, undisturbed, undisturbed / "out", resume=True)),
        pytest.raises(TouchlineError, match="another process plays this cup"),
    ):
        CupRun(cup, undisturbed, undisturbed / "out", resume=True)


def test_an_outcome_survives_the_database() -> None:
    for one in (
        Outcome((2, 1), (3, 4), (1, 0), (0, 2), "ab"),
        Outcome.failed(FailureKind.HUNG, None, "two\nlines"),
    ):
        assert Outcome.from_json(one.to_json()) == one


def test_the_command_reports_a_finished_cup_as_json_and_plays_nothing(undisturbed: Path) -> None:
    arguments = ["tournament", str(undisturbed / "mini.toml"), "--out", str(undisturbed / "out"), "--resume", "--json"]
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 0
    content = json.loads(result.stdout)
    assert content["complete"] is True and content["winner"] in ("One", "Two", "Three")
    assert len(content["matches"]) == 3


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["none.toml"], "none.toml: No such file or directory; give the path of a cup file"),
        (["verify"], "verify needs the folder of a cup"),
        (["verify", "nowhere"], "nowhere: has no cup.sqlite; give the folder of a cup"),
        (["cup.toml", "other"], "other: one cup file is enough"),
    ],
)
def test_wrong_input_of_the_command_is_one_line(arguments: list[str], line: str) -> None:
    result = CliRunner().invoke(app, ["tournament", *arguments])
    assert result.exit_code == 2 and line in result.output and result.output.count("\n") == 1
