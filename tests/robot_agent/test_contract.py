from pathlib import Path

import pytest

from robot_agent.bodies import DriveLimits
from robot_agent.contract import Briefing, load_brain
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.rule_book import load_rule_book
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup
from schemas.side import Side

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

def act(sight):
    return Command(answers_tick=sight.tick)

NUMBER = 4
"""


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "students_team.py").write_text(STUDENT)
    (tmp_path / "broken_team.py").write_text("x = = 1\n")
    (tmp_path / "hungry_team.py").write_text("import a_library_nobody_has\n")
    (tmp_path / "angry_team.py").write_text("\nraise ValueError('not\\ntoday')\n")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.path", ["/nowhere"])
    return tmp_path


def test_a_briefing_has_number_side_and_teammates(setup):
    keeper = Briefing.of("magenta1", setup)
    assert (keeper.side, keeper.number) == (Side.MAGENTA, 1)
    assert Briefing.of("cyan3", setup).teammates == ("cyan1", "cyan2", "cyan4", "cyan5")


def test_a_robot_that_does_not_play_is_named_with_the_nearest_that_does(setup):
    with pytest.raises(TouchlineError, match=r'robot is "cyam2".*friendly.*did you mean "cyan2"\?'):
        Briefing.of("cyam2", setup)


def test_a_class_in_the_current_directory_is_built_with_the_briefing(here, briefing, sight_of):
    brain = load_brain("students_team:Team", briefing)
    assert brain.robot == "cyan2"
    assert brain.act(sight_of(7)).answers_tick == 7


def test_a_plain_function_is_a_brain(here, briefing, sight_of):
    assert load_brain("students_team:act", briefing).act(sight_of(8)).answers_tick == 8


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        ("students_team", 'brain is "students_team"; write it as "module:Class"'),
        ("stu-dents:Team", 'write it as "module:Class"'),
        ("student_team:Team", 'there is no module student_team; did you mean "students_team"?'),
        ("robot_agent.teams.simpel:Simple", 'no module robot_agent.teams.simpel; did you mean "simple"?'),
        ("students_team:Taem", 'students_team has no Taem; did you mean "Team"?'),
        ("students_team:NUMBER", "NUMBER is 4; name a class or a function act(sight)"),
        ("students_team:Dumb", "Dumb has no method act(self, sight); write one"),
        ("students_team:Fragile", "Fragile(briefing) raised KeyError: 'formation' (students_team.py, line 17)"),
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


def test_a_briefing_has_the_numbers_of_the_robots_own_type() -> None:
    types = {"cyan1": "keeper", "cyan3": "slow"}
    config = load_match(None, {"teams.cyan.types": types})
    setup = Setup.of(config, load_profile("msl"), load_rule_book("msl"))
    slow, keeper, plain = (Briefing.of(name, setup).setup for name in ("cyan3", "cyan1", "magenta3"))
    assert DriveLimits.of(slow).speed == 2.0 < DriveLimits.of(plain).speed
    assert keeper.robot.reach > plain.robot.reach == plain.robot.radius
