"""`touchline check`: its lines, its JSON and its exit status, for a brain and for a program of lines."""

import json
import sys
from functools import partial
from pathlib import Path

import pytest
from typer.testing import CliRunner

from support.stepped_clock import SteppedClock
from touchline.commands.cli.command_line import app
from touchline.team.check import examination
from touchline.team.check.checks import CHECKS

PROGRAM = """
import json, sys
briefing = json.loads(sys.stdin.readline())
for line in sys.stdin:
    sight = json.loads(line)
    {extra}
    print(json.dumps({{"answers_tick": sight["tick"], "drive": {{"vx": {speed}}}}}), flush=True)
"""


@pytest.fixture
def check(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Runs the command on a program of lines, one robot of cyan; returns the exit status and the output."""
    monkeypatch.chdir(tmp_path)
    without_time = partial(examination.Examination, clock=SteppedClock())  # how busy the machine is does not matter
    monkeypatch.setattr(examination, "Examination", without_time)
    Path("one.toml").write_text("[teams.cyan]\nsize = 1\n[teams.magenta]\nsize = 1\n")

    def run(*words: str, extra: str = "pass", speed: str = "1.0") -> tuple[int, str]:
        Path("robot.py").write_text(PROGRAM.format(extra=extra, speed=speed))
        program = ["--stdio", f"{sys.executable} robot.py", "--match-file", "one.toml", "--seconds", "1"]
        found = CliRunner().invoke(app, ["check", *(words or program)])
        return found.exit_code, found.output

    return run


def test_a_program_that_keeps_the_contract_has_a_line_for_each_check_and_status_0(check) -> None:
    status, printed = check()
    lines = printed.splitlines()
    assert status == 0, printed
    assert [line.split()[:2] for line in lines] == [["kept", row.name] for row in CHECKS]


def test_a_program_that_breaks_it_is_named_with_its_line_and_status_1(check) -> None:
    status, printed = check(extra="if sight['ball'] is None and sight['tick'] > 50: print('where is it?')")
    assert status == 1
    broken = [line for line in printed.splitlines() if line.startswith("broken")]
    assert broken[0].split()[1] == "ball_unseen"
    assert "cyan1: the program wrote 'where is it?': no JSON object" in broken[0]


def test_a_program_that_crashes_in_a_situation_is_named_with_its_end(check) -> None:
    status, printed = check(extra="if not sight['game']['running'] and sight['holding']: sys.exit(5)")
    assert status == 1
    assert "stopped" in printed and "ended with status 5 at tick" in printed


def test_the_result_as_json_has_the_figures(check) -> None:
    program = ["--stdio", f"{sys.executable} robot.py", "--match-file", "one.toml", "--seconds", "1"]
    status, printed = check(*program, "--json", speed="9.0")
    content = json.loads(printed)
    assert (status, content["kept"]) == (1, False)
    rows = {row["name"]: row for row in content["checks"]}
    assert rows["time"]["figures"]["decisions"] == 49
    assert "drive is 9.00 m/s" in rows["limits"]["sentence"]


@pytest.mark.parametrize("option", ["--stdio", "--command"])
def test_a_quotation_that_is_not_closed_is_one_line(option: str) -> None:
    found = CliRunner().invoke(app, ["check", option, 'node "robot'])
    assert found.exit_code == 2
    assert found.stderr == f'touchline: {option} is node "robot: No closing quotation; close what is open\n'


@pytest.mark.parametrize("words", [[], ["a:B", "--stdio", "cat"]])
def test_without_a_brain_or_with_two_it_is_one_line(check, words: list[str]) -> None:
    found = CliRunner().invoke(app, ["check", *words])
    assert found.exit_code == 2
