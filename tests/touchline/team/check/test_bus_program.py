"""A program that speaks the protocol is checked through it, on a bus of its own."""

import sys
from pathlib import Path

import pytest

from schemas.config.match_config import load_match
from touchline.team.check import bus_program
from touchline.team.check.checks import CHECKS, run_check
from touchline.team.check.examination import Examination
from touchline.team.check.subject import Subject

pytestmark = pytest.mark.processes

ROOT = Path(__file__).parents[4]


def examination(*command: str) -> Examination:
    sizes = {"teams.cyan.size": 1, "teams.magenta.size": 1, "teams.cyan.remote": True}
    return Examination(Subject(load_match(None, sizes), command=command), 0.5)


def test_the_plain_robot_keeps_the_contract_over_zenoh() -> None:
    one = examination(sys.executable, str(ROOT / "examples" / "plain_robot.py"))
    rows = [row for row in CHECKS if row.name in ("build", "repeatable", "set_pieces", "twice")]
    assert [result.sentence for row in rows if not (result := run_check(row, one)).kept] == []


def test_a_program_that_sends_no_commands_is_named(tmp_path: Path) -> None:
    source = (ROOT / "examples" / "plain_robot.py").read_text()
    program = tmp_path / "robot.py"
    program.write_text(source.replace('{"version": "2.0", "answers_tick"', '{"version": "2.0", "tick"'))
    result = run_check(CHECKS[1], examination(sys.executable, str(program)))
    assert "cyan1: the program has sent no command: Command: " in result.sentence


@pytest.mark.parametrize(
    ("code", "how"),
    [
        ("import sys; sys.exit(3)", "the program ended with status 3"),
        ("import signal; signal.pause()", "the program does not claim its robot within 0.5 s"),
    ],
)
def test_a_program_that_does_not_join_is_named(code: str, how: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if "claim" in how:
        monkeypatch.setattr(bus_program, "PROGRAM_S", 0.5)
    result = run_check(CHECKS[0], examination(sys.executable, "-c", code))
    assert not result.kept
    assert how in result.sentence
