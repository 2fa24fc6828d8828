"""docs/robot.md: its transcript is that of a run, its tables are those of the messages and of the checks."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from msgspec.structs import fields

from robot_agent.process.stdio import answers, program
from schemas.config.profile import load_profile
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.radio import Radio
from schemas.messages.sight import BallSight, Motion, Obstacle, Outcome, Sight
from schemas.messages.soccer.game import GameView
from schemas.soccer.game import TeamPhase
from touchline.team.check.checks import CHECKS


@pytest.fixture(scope="module")
def text(root: Path) -> str:
    return (root / "docs" / "robot.md").read_text("utf-8")


def names_of(*kinds: type) -> set[str]:
    return {one.encode_name for kind in kinds for one in fields(kind)}


def section_of(text: str, title: str) -> str:
    return text.partition(f"\n## {title}\n")[2].partition("\n## ")[0]


def test_the_transcript_is_that_of_a_run(text: str, root: Path, fenced: Callable[[str, str], list[str]]) -> None:
    if shutil.which("node") is None:
        assert os.environ.get("TOUCHLINE_EXAMPLES") != "needed", "no node where the examples have to run"
        pytest.skip("no node; apt-get install nodejs")
    script = [sys.executable, str(root / "docs" / "generate" / "robot_transcript.py")]
    environment = {**os.environ, "PYTHONPATH": str(root)}
    run = subprocess.run(script, capture_output=True, text=True, check=True, env=environment, timeout=100)
    assert fenced(text, "text") == [run.stdout], (
        "run: python docs/generate/robot_transcript.py, and put its output there"
    )


def test_it_is_short_enough_to_read(text: str) -> None:
    assert len(text.splitlines()) <= 300
    assert max(map(len, text.splitlines())) <= 250


@pytest.mark.parametrize(
    ("title", "named"),
    [
        ("The sight", names_of(Sight, Motion, BallSight, Obstacle, Outcome)),
        ("The command", names_of(Command, Drive, Kick) | {mode.value for mode in KickMode}),
        ("The game", names_of(GameView) | {phase.value for phase in TeamPhase}),
        ("The radio", names_of(Radio)),
    ],
)
def test_every_field_of_a_line_is_explained(text: str, title: str, named: set[str]) -> None:
    words = set(re.findall(r"\w+", " ".join(re.findall(r"`([^`]+)`", section_of(text, title)))))
    assert sorted(named - words) == []


def test_every_check_stands_in_the_table(text: str) -> None:
    rows = re.findall(r"^\| `(\w+)` \| (.*) \|$", section_of(text, "touchline check"), re.MULTILINE)
    assert rows == [(check.name, check.does) for check in CHECKS]


def test_its_figures_are_those_of_the_code(text: str) -> None:
    profile = load_profile("msl")
    assert f"older than {profile.safety.watchdog:g} s of simulated time brakes" in text
    assert f"a pause of {profile.safety.silence:g} s beyond" in text
    assert "0.02 s. Sights" in text and profile.time.tick == pytest.approx(0.02)
    assert f"send {profile.radio.budget / 1e6:g} Mbit/s" in text
    assert (profile.radio.delay, profile.radio.jitter, profile.radio.loss) == (0.02, 0.02, 0.01)
    assert f"at most {Sight.max_bytes:,} bytes" in text
    assert f"for {program.PROGRAM_SILENT_S:g} s; …" in text


def test_every_fault_of_a_program_stands_in_its_table(text: str) -> None:
    table = section_of(text, "What goes wrong, and what you read")
    reasons = ("no JSON object", "Command: ", "a second answer", "answers_tick is", "has not answered", "after newer")
    assert [reason for reason in (*reasons, "has not read") if reason not in table] == []
    assert len(answers.AnswerFault) == 7
