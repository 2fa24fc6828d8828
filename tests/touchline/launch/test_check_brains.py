from pathlib import Path

import pytest

from schemas.config.match_config import load_match
from schemas.errors import TouchlineError
from touchline.launch.check_brains import check_teams

BRAIN = """
from schemas.messages.command import Command as Imported
class Striker: ...
def act(sight): ...
Alias = Striker
"""


@pytest.fixture(autouse=True)
def brains_here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    Path("my_team.py").write_text(BRAIN)
    Path("broken_team.py").write_text("class Striker(:\n")
    Path("loud_team.py").write_text("raise SystemExit('a brain was run')\nclass Striker: ...\n")


def check(key: str, value: object) -> None:
    # the other team is a program that is everywhere
    overrides = {"teams.cyan.command": ["sh"], "teams.magenta.command": ["sh"]}
    side = key.split(".")[1]
    del overrides[f"teams.{side}.command"]
    check_teams(load_match(None, {**overrides, key: value}))


@pytest.mark.parametrize("name", ["Striker", "act", "Alias", "Imported"])
def test_a_brain_is_found_by_whatever_its_module_binds(name: str) -> None:
    check("teams.cyan.brain", f"my_team:{name}")


def test_looking_for_a_brain_does_not_run_it() -> None:
    check("teams.cyan.brain", "loud_team:Striker")


@pytest.mark.parametrize(
    ("brain", "sentence"),
    [
        (
            "my_taem:Striker",
            r'teams\.cyan\.brain is "my_taem:Striker"; there is no module my_taem; did you mean "my_te',
        ),
        ("my_team:Strikr", r'my_team has no Strikr; did you mean "Striker"\?'),
        ("my_team.deep:Striker", "there is no module my_team.deep|looking for my_team.deep raised"),
        ("broken_team:Striker", r"broken_team\.py, line 1"),
    ],
)
def test_a_brain_that_is_not_there_is_named_with_its_key_and_a_hint(brain: str, sentence: str) -> None:
    with pytest.raises(TouchlineError, match=sentence):
        check("teams.cyan.brain", brain)


def test_a_program_that_is_not_there_is_named() -> None:
    with pytest.raises(TouchlineError, match=r'teams\.magenta\.command begins with "no-such-program"'):
        check("teams.magenta.command", ["no-such-program", "--fast"])


def test_an_empty_command_is_refused() -> None:
    with pytest.raises(TouchlineError, match=r"teams\.cyan\.command is empty"):
        check("teams.cyan.command", [])
