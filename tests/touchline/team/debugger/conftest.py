"""A recorded match, and a folder for brains of the test."""

import sys
from collections.abc import Callable
from itertools import count
from pathlib import Path
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


@pytest.fixture(scope="session")
def played(match_recorder: Callable[..., None], tmp_path_factory: pytest.TempPathFactory) -> Recording:
    """Four seconds of two against two."""
    path = tmp_path_factory.mktemp("played") / "match.mcap"
    match_recorder(path, load_match(None, {"seed": 5, "duration": 20.0, **SIDES}), UNTIL)
    return open_recording(path, whole=True)


@pytest.fixture
def brain(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., str]:
    """Writes a brain that plays as `Simple` but for the given lines, which see `sight` and `command`."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])

    def write(lines: str, top: str = "") -> str:
        module = f"brain_of_test_{next(_NUMBERS)}"
        body = "".join(f"        {line}\n" for line in lines.splitlines())
        (tmp_path / f"{module}.py").write_text(
            "from msgspec.structs import replace\n"
            "from robot_agent.teams.simple import Simple\n"
            "from touchline import Drive\n"
            f"{top}\n"
            "class Mine(Simple):\n"
            "    def act(self, sight):\n"
            "        command = super().act(sight)\n"
            f"{body}"
            "        return command\n"
        )
        return f"{module}:Mine"

    return write


@pytest.fixture
def player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., str]:
    """Writes a `Player` whose `play` has the given lines, which see `self`, `belief` and `order`."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])

    def write(lines: str) -> str:
        module = f"brain_of_test_{next(_NUMBERS)}"
        body = "".join(f"        {line}\n" for line in lines.splitlines())
        (tmp_path / f"{module}.py").write_text(
            "from touchline import Action, Drive, Player, skills\n"
            f"class Mine(Player):\n    def play(self, belief, order):\n{body}"
        )
        return f"{module}:Mine"

    return write


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
