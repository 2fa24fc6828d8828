"""A cup that is played: resumed after it was killed, equal for any number of processes, and served by the command."""

import json
import signal
import subprocess
import sys
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner

from schemas.errors import TouchlineError
from support.cups import CUP, mini_cup, play
from touchline.commands.cli.command_line import app
from touchline.matches.cup.cup_config import load_cup
from touchline.matches.cup.report import report_of
from touchline.matches.cup.run_cup import CupRun


def report_in(folder: Path) -> object:
    """The report on a stored cup."""
    with closing(mini_cup(folder, resume=True)) as run:
        return report_of(run.state)


@pytest.mark.processes
def test_ctrl_c_ends_a_cup_tidily_and_resume_finishes_it(undisturbed: Path, tmp_path: Path) -> None:
    (tmp_path / "mini.toml").write_text(CUP)
    command = [sys.executable, "-m", "touchline", "tournament", str(tmp_path / "mini.toml")]
    command += ["--out", str(tmp_path / "out"), "--jobs", "1", "--json"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    first = json.loads(process.stderr.readline())
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert process.returncode == 128 + signal.SIGINT
    assert (first["done"], first["total"], first["running"], first["failed"]) == (1, 3, 1, 0)
    assert json.loads(out)["complete"] is False
    assert "interrupted; --resume goes on" in err and "Traceback" not in err
    assert "the cup is not complete" in (tmp_path / "out" / "index.html").read_text()
    with closing(mini_cup(tmp_path, resume=True)) as run:
        assert report_of(play(run, 1)) == report_in(undisturbed)


def test_pages_and_recordings_of_all_matches_are_in_the_folder(undisturbed: Path) -> None:
    out = undisturbed / "out"
    names = {f"{stage}_{number}" for stage in ("admission", "league") for number in (1, 2, 3)}
    assert {file.stem for file in (out / "recordings").iterdir()} == names
    assert {file.stem for file in (out / "matches").iterdir()} == names
    assert list((out / "logs").iterdir()) == []
    page = (out / "matches" / "league_3.html").read_text("utf-8")
    assert 'id="pitch"' in page and '<nav><a href="../index.html">' in page
    index = (out / "index.html").read_text("utf-8")
    assert "Winner" in index and "refresh" not in index


def test_the_place_of_a_match_in_the_cup_and_the_folder_are_no_part_of_its_identity(tmp_path: Path) -> None:
    with closing(mini_cup(tmp_path)) as run:
        slots = [one.slot for one in run.state.matches]
        identities = {run.plan.match(slot).identity for slot in slots}
        moved = replace(run.plan, folder=tmp_path / "elsewhere")
        assert identities == {moved.match(slot).identity for slot in slots}
        assert len(identities) == 6


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
    mini_cup(tmp_path).close()
    mini_cup(tmp_path, resume=True).close()
    (tmp_path / "own_team.py").write_text("class Own: pass")
    with pytest.raises(TouchlineError, match='files of team "Three" have changed since the cup began'):
        mini_cup(tmp_path, resume=True)


def test_a_team_with_other_files_than_were_submitted_does_not_play(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "own_team.py").write_text("class Own: ...")
    monkeypatch.chdir(tmp_path)
    printed = CliRunner().invoke(app, ["tournament", "digest", "own_team:Own"])
    assert printed.exit_code == 0
    mistyped = CliRunner().invoke(app, ["tournament", "digest", "own_team:Owm"])
    assert mistyped.exit_code == 2 and "own_team.py has no Owm; name the module" in mistyped.output
    digest = printed.stdout.strip()
    (tmp_path / "mini.toml").write_text(CUP.replace('"random"', f'"own_team:Own"\ndigest = "{digest}"'))
    mini_cup(tmp_path).close()
    (tmp_path / "own_team.py").write_text("class Own: pass")
    with pytest.raises(
        TouchlineError, match=f'the files of team "Three" have the digest .*, and {digest} was submitted'
    ):
        mini_cup(tmp_path)


def test_the_command_reports_a_finished_cup_as_json_and_plays_nothing(undisturbed: Path) -> None:
    arguments = ["tournament", str(undisturbed / "mini.toml"), "--out", str(undisturbed / "out"), "--resume", "--json"]
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 0
    content = json.loads(result.stdout)
    assert content["complete"] is True and content["winner"] in ("One", "Two", "Three")
    assert len(content["matches"]) == 6


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["none.toml"], "none.toml: No such file or directory; give the path of a cup file"),
        (["verify"], "Missing argument 'FOLDER'"),
        (["verify", "cup", "--resume"], "No such option: --resume"),  # of `run`: it would have no effect
        (["verify", "nowhere"], "nowhere: has no run.sqlite; give the folder of a run"),
        (["cup.toml", "other"], "unexpected extra argument"),
        (["digest", "none:Team"], "none:Team: no file of it is in"),
        (["matches/cup.toml", "--dask", "tcp://127.0.0.1:9", "--jobs", "2"], "leave one out"),
    ],
)
def test_wrong_input_of_the_command_is_one_line(arguments: list[str], line: str) -> None:
    result = CliRunner().invoke(app, ["tournament", *arguments])
    assert result.exit_code == 2 and line in result.output and result.output.count("\n") == 1
