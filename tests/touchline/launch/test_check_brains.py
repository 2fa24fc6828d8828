"""Brains are built once before a match is launched, each team's in a process of its own."""

import sys
from pathlib import Path

import pytest

from schemas.config.match_config import load_match
from schemas.errors import TouchlineError
from touchline.launch import check_brains
from touchline.launch.check_brains import check_reload, check_teams

pytestmark = pytest.mark.processes

BRAIN = """
import os, signal, sys, threading

class Striker:
    def __init__(self, briefing):
        assert os.environ["TOUCHLINE_ROBOT"] == briefing.robot
        assert os.environ["TOUCHLINE_SIDE"] == briefing.side.value
        print("ready")

    def act(self, sight): ...

class Mapped(Striker):
    def __init__(self, briefing):
        self.role = {1: "keeper", 2: "wing"}[briefing.number]

class Threaded(Striker):
    def __init__(self, briefing):
        threading.Thread(target=threading.Event().wait).start()

class Crashes(Striker):
    def __init__(self, briefing):
        sys.stderr.write("no graphics card\\n")
        sys.stderr.flush()
        os.kill(os.getpid(), signal.SIGSEGV)

class Hangs(Striker):
    def __init__(self, briefing):
        threading.Event().wait()
"""


@pytest.fixture(autouse=True)
def brains_here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("my_team.py").write_text(BRAIN)


def check(key: str, value: object, brain_folder: Path | None = None, **more: object) -> list[str]:
    """Check a match in which the other team is a program that is everywhere; returns what was reported."""
    overrides = {"teams.cyan.command": ["sh"], "teams.magenta.command": ["sh"], **more}
    side = key.split(".")[1]
    del overrides[f"teams.{side}.command"]
    reported: list[str] = []
    check_teams(load_match(None, {**overrides, key: value}), brain_folder, reported.append)
    return reported


@pytest.mark.parametrize("name", ["Striker", "Threaded"])
def test_a_brain_that_can_be_built_is_accepted_without_a_line(name: str) -> None:
    assert check("teams.cyan.brain", f"my_team:{name}") == []


def test_a_brain_is_not_loaded_into_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(sys.modules, "my_team", raising=False)  # other tests have brains of that name
    check("teams.cyan.brain", "my_team:Striker")
    assert "my_team" not in sys.modules


@pytest.mark.parametrize(
    ("brain", "sentence"),
    [
        ("my_taem:Striker", r'there is no module my_taem in the current directory \(/.*\); did you mean "my_team"\?$'),
        ("my_team:Mapped", r"Mapped\(briefing\) raised KeyError: 3 \(my_team\.py, line 14\) for magenta3$"),
        ("my_team:Crashes", r"the process that builds it was ended by SIGSEGV: no graphics card$"),
    ],
)
def test_a_brain_that_cannot_be_built_is_reported_with_its_key_and_a_remedy(brain: str, sentence: str) -> None:
    with pytest.raises(TouchlineError, match=sentence) as caught:
        check("teams.magenta.brain", brain)
    assert str(caught.value).startswith(f'teams.magenta.brain is "{brain}"; ')
    assert "\n" not in str(caught.value)


def test_a_brain_that_is_not_built_in_time_is_reported_and_its_process_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check_brains, "STATUS_S", 0.0)
    monkeypatch.setattr(check_brains, "HANG_S", 0.0)
    reported: list[str] = []
    config = load_match(
        None, {"patience.attendance": 0.1, "teams.cyan.brain": "my_team:Hangs", "teams.magenta.command": ["sh"]}
    )
    with pytest.raises(TouchlineError, match=r"were not built within 0\.5 s; shorten __init__, or raise patience\."):
        check_teams(config, None, reported.append)
    assert reported == ["waiting for my_team:Hangs to be built"]


def test_a_brain_beside_the_match_file_is_found_from_any_directory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.chdir(elsewhere)
    check("teams.cyan.brain", "my_team:Striker", tmp_path)
    with pytest.raises(TouchlineError, match="there is no module my_team in the current directory"):
        check("teams.cyan.brain", "my_team:Striker")


def test_a_program_that_is_not_there_is_named() -> None:
    with pytest.raises(TouchlineError, match=r'teams\.magenta\.command begins with "no-such-program"'):
        check("teams.magenta.command", ["no-such-program", "--fast"])


def test_an_empty_command_is_refused() -> None:
    with pytest.raises(TouchlineError, match=r"teams\.cyan\.command is empty"):
        check("teams.cyan.command", [])


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"teams.cyan": {"command": ["a"]}, "teams.magenta": {"remote": True}}, "no team of this match has one"),
        ({"isolate": "bubblewrap"}, "do not see changed files"),
        ({"teams.cyan": {"brain": "nubot", "process": "team"}}, "share their modules"),
    ],
)
def test_code_is_reloaded_only_where_brains_can_see_it(changes: dict[str, object], sentence: str) -> None:
    check_reload(load_match(None, {"teams.cyan": {"command": ["a"]}}))
    with pytest.raises(TouchlineError, match=sentence):
        check_reload(load_match(None, changes))
