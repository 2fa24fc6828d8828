"""A recorded match, and a folder for brains of the test."""

import sys
from collections.abc import Callable
from itertools import count
from pathlib import Path
from textwrap import indent
from typing import Any

import pytest

from recordings.reading.recording import Recording, open_recording
from schemas.config.match_config import load_match
from support.recorded_match import match_recorder
from touchline.team.debugger.agent_replay import AgentReplay

__all__ = ["match_recorder"]

SIMPLE = "robot_agent.teams.simple:Simple"
SIDES = {f"teams.{side}": {"size": 2, "brain": SIMPLE} for side in ("cyan", "magenta")}
UNTIL = 4.0
_NUMBERS = count()
PLAYS_AS_SIMPLE = """from msgspec.structs import replace
from robot_agent.teams.simple import Simple
from touchline import Drive
class Mine(Simple):
    def act(self, sight):
        command = super().act(sight)
"""
PLAYS = """from touchline import Action, Drive, Player, skills
class Mine(Player):
    def play(self, belief, order):
"""


@pytest.fixture(scope="session")
def played(match_recorder: Callable[..., None], tmp_path_factory: pytest.TempPathFactory) -> Recording:
    """Four seconds of two against two."""
    path = tmp_path_factory.mktemp("played") / "match.mcap"
    match_recorder(path, load_match(None, {"seed": 5, "duration": 20.0, **SIDES}), UNTIL)
    return open_recording(path, whole=True)


@pytest.fixture
def module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str, str, str], str]:
    """Writes the class `Mine`: the lines before those of the test, these, and those after them."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])

    def write(before: str, lines: str, after: str) -> str:
        name = f"brain_of_test_{next(_NUMBERS)}"
        (tmp_path / f"{name}.py").write_text(f"{before}{indent(lines, ' ' * 8)}\n{after}")
        return f"{name}:Mine"

    return write


@pytest.fixture
def brain(module: Callable[[str, str, str], str]) -> Callable[..., str]:
    """Writes a brain that plays as `Simple` but for the given lines, which see `sight` and `command`."""
    return lambda lines, top="": module(f"{top}\n{PLAYS_AS_SIMPLE}", lines, "        return command\n")


@pytest.fixture
def player(module: Callable[[str, str, str], str]) -> Callable[[str], str]:
    """Writes a `Player` whose `play` has the given lines, which see `self`, `belief` and `order`."""
    return lambda lines: module(PLAYS, lines, "")


@pytest.fixture
def replay(played: Recording) -> Callable[..., int]:
    """Replays the recorded match with a brain for cyan2; returns the exit status."""

    def run(spec: str, **options: Any) -> int:
        return AgentReplay(Path(played.path), "cyan2", spec, **options).run()

    return run


@pytest.fixture
def typed(monkeypatch: pytest.MonkeyPatch) -> Callable[..., list[str]]:
    """Types these commands at the prompts of the debugger; returns those that are left."""

    def type_in(*commands: str) -> list[str]:
        left = list(commands)
        monkeypatch.setattr("builtins.input", lambda _prompt="": left.pop(0))
        return left

    return type_in
