import pkgutil
import sys
from pathlib import Path

import pytest

from robot_agent import teams
from robot_agent.loading.brain_loader import load_brain
from schemas.config.shipped_teams import SHIPPED_TEAMS
from schemas.errors import TouchlineError

STUDENT = """
from schemas.messages.command import Command

class Team:
    def __init__(self, briefing):
        self.robot = briefing.robot

    def act(self, sight):
        return Command(answers_tick=sight.tick)

class Dumb:
    def __init__(self, briefing):
        pass

class Fragile:
    def __init__(self, briefing):
        raise KeyError("formation")

    def act(self, sight):
        return None

class WithoutInit:
    def act(self, sight):
        return None

class Greedy:
    def __init__(self, briefing, formation):
        pass

    def act(self, sight):
        return None

class Blind:
    def __init__(self, briefing):
        pass

    def act(self):
        return None

class Later:
    def __init__(self, briefing):
        pass

    async def act(self, sight):
        return None

class Stream:
    def __init__(self, briefing):
        pass

    def act(self, sight):
        yield None

class Quitter:
    def __init__(self, briefing):
        raise SystemExit("no licence")

    def act(self, sight):
        return None

class Parsing:
    def __init__(self, briefing):
        import json
        json.loads("no")

    def act(self, sight):
        return None

def act(sight):
    return Command(answers_tick=sight.tick)

def nothing():
    return None

NUMBER = 4
"""


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "students_team.py").write_text(STUDENT)
    (tmp_path / "broken_team.py").write_text("x = = 1\n")
    (tmp_path / "hungry_team.py").write_text("import a_library_nobody_has\n")
    (tmp_path / "angry_team.py").write_text("\nraise ValueError('not\\ntoday')\n")
    (tmp_path / "leaving_team.py").write_text("import sys; sys.exit('no display')\n")
    for name in ("students_team", "broken_team", "hungry_team", "angry_team", "leaving_team"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.path", [entry for entry in sys.path if entry])
    return tmp_path


def test_a_class_in_the_current_directory_is_built_with_the_briefing(here, briefing, sight_of):
    brain = load_brain("students_team:Team", briefing)
    assert brain.robot == "cyan2"
    assert brain.act(sight_of(7)).answers_tick == 7


@pytest.mark.parametrize("team", SHIPPED_TEAMS)
def test_the_name_of_a_shipped_team_is_its_brain(briefing, team):
    assert type(load_brain(team, briefing)).__name__.lower() == team


def test_every_folder_of_the_shipped_teams_is_known_by_its_name():
    assert [module.name for module in pkgutil.iter_modules(teams.__path__) if module.ispkg] == list(SHIPPED_TEAMS)


def test_a_plain_function_is_a_brain(here, briefing, sight_of):
    assert load_brain("students_team:act", briefing).act(sight_of(8)).answers_tick == 8


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        (
            "students_team",
            'brain is "students_team"; write "module:Class", "policy:FILE.zip", "policy:FILE.npz", or the name of a '
            "shipped team; known: nub",
        ),
        ("simpel", 'did you mean "simple"?'),
        ("stu-dents:Team", 'brain is "stu-dents:Team"; write "module:Class"'),
        ("student_team:Team", 'did you mean "students_team"?'),
        ("robot_agent.teams.simpel:Simple", 'no module robot_agent.teams.simpel; did you mean "simple"?'),
        ("students_team:Taem", 'students_team has no Taem; did you mean "Team"?'),
        ("students_team:NUMBER", "NUMBER is 4; name a class or a function act(sight)"),
        ("students_team:Dumb", "Dumb (students_team.py, line 11) has no method act(self, sight); write one"),
        ("students_team:Fragile", "(briefing) raised KeyError: 'formation' (students_team.py, line 17) for cyan2"),
        (
            "students_team:WithoutInit",
            "WithoutInit.__init__ (students_team.py, line 22) does not take the briefing alone; write def __in",
        ),
        ("students_team:Greedy", "Greedy.__init__ (students_team.py, line 27) does not take the briefing alone"),
        (
            "students_team:Blind",
            "Blind.act (students_team.py, line 37) does not take the sight alone; write def act(self, sight)",
        ),
        ("students_team:nothing", "nothing(sight) (students_team.py, line 72) does not take the sight alone; write"),
        ("students_team:Later", "Later.act (students_team.py, line 44) is async; write def act(self, sight) with"),
        ("students_team:Stream", "Stream.act (students_team.py, line 51) yields; return one Command"),
        ("students_team:Quitter", "(briefing) raised SystemExit: no licence (students_team.py, line 56) for cyan2"),
        ("students_team:Parsing", "(students_team.py, line 64) for cyan2"),
        ("leaving_team:Team", "importing leaving_team raised SystemExit: no display (leaving_team.py, line 1)"),
        ("no_team:Team", "there is no module no_team in the current directory (/"),
        ("students_team.deep:Team", "there is no module students_team.deep; students_team has no modules"),
        ("broken_team:Team", "importing broken_team raised SyntaxError: invalid syntax"),
        ("hungry_team:Team", "hungry_team imports a_library_nobody_has, which is not installed; install it"),
        ("angry_team:Team", "importing angry_team raised ValueError: not today (angry_team.py, line 2)"),
    ],
)
def test_an_invalid_brain_is_reported_in_one_line(here, briefing, spec, said):
    with pytest.raises(TouchlineError) as caught:
        load_brain(spec, briefing)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_brain_beside_the_match_file_comes_before_one_in_the_current_directory(here, briefing, sight_of):
    cup = here / "cup"
    cup.mkdir()
    (cup / "students_team.py").write_text("def act(sight): return 'beside'\n")
    assert load_brain("students_team:act", briefing, cup).act(sight_of(1)) == "beside"


def test_a_module_in_neither_folder_is_reported_with_both(here, briefing):
    cup = here / "cup"
    cup.mkdir()
    (cup / "strikers.py").touch()
    with pytest.raises(TouchlineError) as caught:
        load_brain("striker:Team", briefing, cup)
    places = f"beside the match file ({cup}) or in the current directory ({here})"
    assert f'there is no module striker {places}; did you mean "strikers"?' in str(caught.value)


@pytest.mark.parametrize("spec", ["colorsys:Team", "colorsys.striker:Team", "typer:Team"])
def test_a_file_named_as_a_module_of_python_or_of_a_package_is_not_loaded_in_its_place(here, briefing, spec):
    top = spec.partition(":")[0].partition(".")[0]
    (here / f"{top}.py").write_text("class Team: ...\n")
    with pytest.raises(TouchlineError, match=rf"the module {top} is /.*, not {here}/{top}\.py; rename that file"):
        load_brain(spec, briefing)


def test_the_folders_of_brains_come_last_on_the_module_path(here, briefing):
    cup = here / "cup"
    cup.mkdir()
    before = list(sys.path)
    load_brain("students_team:Team", briefing, cup)
    assert sys.path == [*before, str(cup), str(here)]


@pytest.mark.parametrize("line", ["from recordings import Plan", "import recordings.tactics"])
def test_a_module_of_the_team_that_one_of_touchline_hides_is_named_with_its_file(here, briefing, monkeypatch, line):
    (here / "hidden_team.py").write_text(f"{line}\n")
    (here / "recordings.py").write_text("class Plan:\n    pass\n")
    monkeypatch.delitem(sys.modules, "hidden_team", raising=False)
    with pytest.raises(TouchlineError, match=r"importing hidden_team raised .*hidden_team\.py, line 1") as caught:
        load_brain("hidden_team:Team", briefing)
    assert str(caught.value).endswith(f"recordings is Touchline's, not {here / 'recordings.py'}; rename that file")
