"""The cup file, and one line for each of its faults."""

from pathlib import Path

import pytest

from schemas.errors import TouchlineError
from touchline.matches.cup.cup_config import CupConfig, FormatKind, load_cup
from touchline.matches.cup.tie_breaks import ORDERS

TEAMS = '[[teams]]\nname = "A"\nbrain = "simple"\n[[teams]]\nname = "B"\nbrain = "nubot"\n'


def cup_of(tmp_path: Path, text: str) -> CupConfig:
    path = tmp_path / "cup.toml"
    path.write_text(text)
    return load_cup(path)


def test_two_teams_are_enough_for_a_cup(tmp_path: Path) -> None:
    cup = cup_of(tmp_path, TEAMS)
    assert cup.names == ["A", "B"]
    assert cup.format.kind is FormatKind.ROUND_ROBIN
    assert (cup.ranking.points.win, cup.ranking.points.draw, cup.ranking.points.loss) == (3, 1, 0)


@pytest.mark.parametrize(
    ("rules", "order"),
    [("china-sim-2020", "china-sim-2020"), ("msl-2016", "msl-2016"), ("msl", "msl-2016"), ("friendly", "msl-2016")],
)
def test_the_rule_book_of_the_match_brings_the_order_of_tie_breaks(tmp_path: Path, rules: str, order: str) -> None:
    assert cup_of(tmp_path, f'[match]\nrules = "{rules}"\n{TEAMS}').ranking.order == ORDERS[order]


def test_an_order_of_its_own_replaces_that_of_the_rule_book(tmp_path: Path) -> None:
    cup = cup_of(tmp_path, f'[table]\nwin = 2\norder = ["direct match", "goals"]\n{TEAMS}')
    assert cup.ranking.order == ("direct match", "goals")
    assert cup.ranking.points.win == 2


def test_keys_of_the_match_are_those_of_a_match_file(tmp_path: Path) -> None:
    cup = cup_of(tmp_path, f"[match]\nduration = 20.0\n[match.radio]\nloss = 0.5\n{TEAMS}")
    config = cup.match_config()
    assert (config.duration, config.radio.loss) == (20.0, 0.5)


def test_the_rule_book_that_the_docs_shorten_matches_with_is_in_the_folder_of_the_cup(tmp_path: Path) -> None:
    page = (Path(__file__).parents[4] / "docs" / "many_matches.md").read_text()
    text = next(part for part in page.split("```toml\n") if part.startswith('extends = "msl"')).partition("```")[0]
    (tmp_path / "short.toml").write_text(text)
    periods = cup_of(tmp_path, f'[match]\nrules = "short.toml"\n{TEAMS}').match_config().load_rule_book().periods
    assert (periods.parking, periods.half_time_break) == (0.0, 2.0)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("", "teams is missing; write [[teams]] above each team"),
        ('[[teams]]\nname = "A"\nbrain = "simple"\n', "a cup has 2 to 64"),
        (TEAMS.replace('"B"', '"A"'), 'two teams are named "A"'),
        (TEAMS.replace('brain = "nubot"', ""), '"B" has none; give one of brain, command and stdio'),
        (TEAMS + 'command = ["x"]\n', '"B" has brain and command; give one'),
        ('way = "in process"\n' + TEAMS, 'one of "in_process", "processes"'),
        (TEAMS + "remote = true\n", "a remote team cannot be started again after a crash"),
        (TEAMS + 'digest = "12"\n', "32 hexadecimal digits, as touchline tournament digest prints them"),
        (TEAMS + 'colour = "red"\n', "colour is not known"),
        (TEAMS.replace('brain = "nubot"', 'command = ["x"]'), 'team "B" is a program on the network; write way'),
        ('[format]\nkind = "league"\n' + TEAMS, "format.kind is 'league'; one of"),
        ('[format]\nkind = "knock-out"\nbest_of = 2\n' + TEAMS, "format.best_of is 2; a knock-out needs an odd number"),
        ('[format]\nkind = "groups"\n' + TEAMS, "format.groups is 2; with 2 teams at most 1"),
        (
            '[format]\nkind = "groups"\ngroups = 1\nadvance = 3\n' + TEAMS,
            "format.advance is 3; the smallest group has 2",
        ),
        ('[format]\nkind = "swiss"\nrounds = 3\n' + TEAMS, "format.rounds is 3; with 2 teams at most 1"),
        ('[format]\nkind = "swiss"\n[until_significant]\n' + TEAMS, "until_significant is for round-robin"),
        ('[table]\norder = "msl-2015"\n' + TEAMS, "msl-2016"),
        ('[table]\norder = ["goal"]\n' + TEAMS, '"goal" is no criterion'),
        ("[match]\nduration = -1.0\n" + TEAMS, "match.duration is -1.0; playing time of all halves"),
        ('[match]\nrules = "msk"\n' + TEAMS, "msk"),
        ("[match]\nseed = 3\n" + TEAMS, "match.seed is decided by the cup; leave it out"),
        ('[match]\ngame = "free"\n' + TEAMS, 'match.game is "free", and a cup counts goals; leave it out'),
        ("[match\n", "not TOML"),
    ],
)
def test_a_fault_is_one_line_that_names_the_file(tmp_path: Path, text: str, line: str) -> None:
    with pytest.raises(TouchlineError) as caught:
        cup_of(tmp_path, text)
    message = str(caught.value)
    assert "\n" not in message and line in message and "cup.toml" in message


def test_a_cup_file_that_does_not_exist_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(TouchlineError, match="give the path of a cup file"):
        load_cup(tmp_path / "none.toml")
